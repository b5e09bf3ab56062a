function bytes(text) {
  return Uint8Array.from(atob(text), character => character.charCodeAt(0));
}

// Far enough for the whole structure to fit into a window of any shape. In the viewer y is up.
function placeCamera(viewer) {
  const camera = viewer.camera, half = Math.tan(look.field_of_view_deg * Math.PI / 360);
  // A wide window has room beside the card, a narrow one above it: the picture is centred there.
  const across = window.innerWidth > 900 ? 1 - 336 / window.innerWidth : 1;
  const upwards = window.innerWidth > 600 ? 1 : 0.6;
  const aspect = across * window.innerWidth / window.innerHeight;
  const distance = Math.max(look.half_height / (half * upwards), look.half_breadth / (half * aspect)) + 0.4 * (look.depth || look.half_breadth);
  const [x, y, z] = look.from;
  camera.fov = look.field_of_view_deg;
  camera.near = distance / 100;
  camera.far = 10 * distance;
  viewer.controls.target.set(0, look.centre, 0);
  camera.position.set(x * distance, look.centre + z * distance, -y * distance);
  viewer.controls.update();
  camera.setViewOffset(1, 1, (across - 1) / 2, (1 - upwards) / 2, 1, 1);
  viewer.set_3d_pane_size();
}

// Put a tag beside a point of the scene, [x, y, z] with z up; hide it where there is none.
function placeTag(viewer, tag, point) {
  tag.hidden = point === null;
  if (point === null) return;
  const camera = viewer.camera, place = camera.position.clone().set(point[0], point[2], -point[1]);
  camera.updateMatrixWorld();
  place.project(camera);
  tag.style.left = (place.x + 1) / 2 * window.innerWidth + "px";
  tag.style.top = (1 - place.y) / 2 * window.innerHeight + "px";
}

const element = id => document.getElementById(id);
const minus = text => text.replace(/^-(?=0(\.0*)?$)/, "").replace("-", "\u2212");
