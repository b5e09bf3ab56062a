// One structure in one place, which shows a mode.
class Place {
  constructor(viewer, number) {
    const find = (...path) => viewer.scene_tree.find(["meshcat", "places", String(number), ...path]).object;
    this.root = find();
    this.wall = find("wall", "<object>");
    this.wall.frustumCulled = false;
    this.rna = find("rna");
    this.rest = this.wall.geometry.attributes.position.array.slice();
    this.tag = document.querySelectorAll(".tag")[number];
    this.mode = null;
  }

  // Colours are the amplitude; a wall that turns carries dark stripes, or one would not see it.
  choose(mode) {
    this.mode = mode;
    this.root.visible = mode !== null;
    if (mode === null) return;
    const colour = this.wall.geometry.attributes.color, last = modes.ramp.length - 1;
    modes.share[mode].forEach((share, ring) => {
      const shown = modes.ramp[Math.round(Math.min(share, 1) * last)];
      for (let i = 0; i < modes.facets; ++i) {
        const dark = modes.torsion[mode] && i % (modes.facets / 4) < 2 ? 0.25 : 1;
        for (let j = 0; j < 3; ++j) colour.array[3 * (ring * modes.facets + i) + j] = dark * shown[j];
      }
    });
    colour.needsUpdate = true;
    this.tag.innerHTML = "";
    const name = document.createElement("b");
    name.textContent = modes.label[mode];
    this.tag.append(name, " " + frequency(mode) + ", " + damping(mode));
  }

  // The shape times a factor: centres of rings move linearly, rings turn about them as they are.
  show(factor) {
    const place = this.wall.geometry.attributes.position, turn = this.rna.quaternion.clone();
    const point = this.rna.position.clone(), axis = point.clone();
    modes.motion[this.mode].forEach((motion, ring) => {
      const height = modes.height[ring];
      axis.set(motion[3], motion[4], motion[5]);
      const angle = factor * axis.length();
      turn.setFromAxisAngle(axis.length() > 0 ? axis.normalize() : axis.set(0, 0, 1), angle);
      for (let i = 3 * ring * modes.facets; i < 3 * (ring + 1) * modes.facets; i += 3) {
        point.set(this.rest[i], this.rest[i + 1], this.rest[i + 2] - height).applyQuaternion(turn);
        place.array[i] = point.x + factor * motion[0];
        place.array[i + 1] = point.y + factor * motion[1];
        place.array[i + 2] = point.z + height + factor * motion[2];
      }
      if (ring === modes.height.length - 1) {
        this.rna.position.set(factor * motion[0], factor * motion[1], height + factor * motion[2]);
        this.rna.quaternion.copy(turn);
        this.rna.updateMatrix();
      }
    });
    place.needsUpdate = true;
    this.wall.geometry.computeVertexNormals();
  }
}

const frequency = mode => modes.frequency[mode].toPrecision(4) + "\u00a0Hz";
const damping = mode => (100 * modes.damping[mode]).toPrecision(3) + "\u00a0%";

class Player {
  constructor(viewer) {
    this.viewer = viewer;
    this.places = Array.from(document.querySelectorAll(".tag"), (_, k) => new Place(viewer, k));
    this.shown = modes.first.slice();
    this.beside = true;
    this.playing = true;
    this.amplitude = 1;
    this.speed = 1;
    this.now = 0;
    this.last = null;
  }

  // The slowest of the modes shown gives the slider its length.
  get length() {
    return 1 / Math.min(...this.shown.map(mode => modes.frequency[mode]));
  }

  arrange() {
    const count = this.shown.length, breadth = this.breadth = this.breadth || look.half_breadth;
    look.half_breadth = breadth + (count - 1) / 2 * look.spacing;
    placeCamera(this.viewer);
    this.places.forEach((place, k) => {
      place.choose(k < count ? this.shown[k] : null);
      const off = (k - (count - 1) / 2) * look.spacing;
      place.root.position.set(off * look.right[0], off * look.right[1], 0);
      place.root.updateMatrix();
    });
    document.querySelectorAll(".mode").forEach((button, mode) => {
      button.setAttribute("aria-pressed", this.shown.includes(mode));
    });
    const rows = this.shown.map(mode => {
      const row = document.createElement("tr"), cell = row.insertCell(), name = document.createElement("b");
      name.textContent = modes.label[mode];
      const words = document.createElement("small");
      words.textContent = modes.name[mode] + ", peak " + modes.peak[mode];
      cell.append(name, words);
      row.insertCell().textContent = frequency(mode);
      row.insertCell().textContent = damping(mode);
      return row;
    });
    element("shown").replaceChildren(...rows);
    this.show(this.now);
  }

  // One mode alone, or one more beside the others, of which the first gives way if there are too many.
  press(mode) {
    if (!this.beside) this.shown = [mode];
    else if (!this.shown.includes(mode)) this.shown = [...this.shown, mode].slice(-this.places.length);
    else if (this.shown.length > 1) this.shown = this.shown.filter(other => other !== mode);
    this.arrange();
  }

  show(now) {
    this.now = now;
    this.shown.forEach((mode, k) => {
      const place = this.places[k], at = place.root.position;
      place.show(this.amplitude * Math.sin(2 * Math.PI * modes.frequency[mode] * now));
      placeTag(this.viewer, place.tag, [at.x, at.y, look.low]);
    });
    for (const place of this.places.slice(this.shown.length)) place.tag.hidden = true;
    element("time").value = now / this.length % 1;
    element("now").textContent = (now % this.length).toFixed(2) + "\u00a0s";
    this.viewer.set_dirty();
  }

  tick(stamp) {
    if (this.playing && this.last !== null) this.show(this.now + this.speed * (stamp - this.last) / 1000);
    this.last = stamp;
    requestAnimationFrame(next => this.tick(next));
  }
}

var viewer = null, player = null;
try {
  viewer = new MeshCat.Viewer(element("scene"));
} catch (error) {
  element("pause").replaceWith("This browser offers no WebGL, which the picture needs.");
}
if (viewer) {
  for (const command of commands) viewer.handle_command_bytearray(bytes(command));
  player = new Player(viewer);
  player.speed = Number(element("speed").value);
  document.querySelectorAll(".mode").forEach((button, mode) => { button.onclick = () => player.press(mode); });
  element("beside").onchange = event => {
    player.beside = event.target.checked;
    if (!player.beside) player.shown = player.shown.slice(0, 1);
    player.arrange();
  };
  element("amplitude").oninput = event => {
    player.amplitude = Number(event.target.value);
    element("times").textContent = "× " + player.amplitude;
    player.show(player.now);
  };
  element("time").oninput = event => player.show(Number(event.target.value) * player.length);
  element("speed").onchange = event => { player.speed = Number(event.target.value); };
  element("pause").onclick = () => {
    player.playing = !player.playing;
    element("pause").textContent = player.playing ? "Pause" : "Play";
  };
  window.addEventListener("resize", () => player.arrange());
  player.arrange();
  player.tick(null);
}
