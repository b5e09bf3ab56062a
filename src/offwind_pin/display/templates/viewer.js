function bytes(text) {
  return Uint8Array.from(atob(text), character => character.charCodeAt(0));
}

// Far enough for the whole structure to fit into a window of any shape. In the viewer y is up.
function placeCamera(viewer) {
  const camera = viewer.camera, half = Math.tan(look.field_of_view_deg * Math.PI / 360);
  const aspect = window.innerWidth / window.innerHeight;
  const distance = Math.max(look.half_height / half, look.half_breadth / (half * aspect)) + 0.4 * look.half_breadth;
  const [x, y, z] = look.from;
  camera.fov = look.field_of_view_deg;
  camera.near = distance / 100;
  camera.far = 10 * distance;
  viewer.controls.target.set(0, look.centre, 0);
  camera.position.set(x * distance, look.centre + z * distance, -y * distance);
  viewer.controls.update();
  // A wide window has room beside the card: the middle of the picture moves there.
  if (window.innerWidth > 900) camera.setViewOffset(1, 1, -0.1, 0, 1, 1);
  viewer.set_3d_pane_size();
}
