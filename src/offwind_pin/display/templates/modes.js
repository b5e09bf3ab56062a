// One structure in one place, which shows a mode.
class Place {
  constructor(viewer, number) {
    const find = (...path) => viewer.scene_tree.find(["meshcat", "places", String(number), ...path]).object;
    this.root = find();
    this.wall = find("wall", "<object>");
    this.wall.frustumCulled = false;
    this.rna = find("rna");
    this.dampers = modes.damper_height.map((_, d) => find("damper", String(d)));
    this.springs = modes.spring_height.map((_, s) => {
      const symbol = find("spring"), spring = s ? symbol.clone() : symbol;
      this.root.add(spring);
      return spring;
    });
    this.rest = this.wall.geometry.attributes.position.array.slice();
    this.turn = this.rna.quaternion.clone();
    this.point = this.rna.position.clone();
    this.axis = this.point.clone();
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
    const numbers = document.createElement("span");
    numbers.textContent = " " + frequency(mode) + ", " + damping(mode);
    this.tag.append(name, numbers);
  }

  // How the axis turns where it moves so: [x, y, z, rx, ry, rz] at the peak, times a factor.
  turnAs(motion, factor) {
    this.axis.set(motion[3], motion[4], motion[5]);
    const angle = factor * this.axis.length();
    if (angle) this.axis.normalize(); else this.axis.set(0, 0, 1);
    this.turn.setFromAxisAngle(this.axis, angle);
  }

  // Where that motion takes a point at rest beside the axis at a height, once it has turned.
  carry(motion, factor, height, x, y, z) {
    this.point.set(x, y, z).applyQuaternion(this.turn);
    this.point.x += factor * motion[0];
    this.point.y += factor * motion[1];
    this.point.z += height + factor * motion[2];
    return this.point;
  }

  // The shape times a factor: centres of rings move linearly, rings turn about them as they are.
  show(factor) {
    const place = this.wall.geometry.attributes.position, motions = modes.motion[this.mode];
    motions.forEach((motion, ring) => {
      const height = modes.height[ring];
      this.turnAs(motion, factor);
      for (let i = 3 * ring * modes.facets; i < 3 * (ring + 1) * modes.facets; i += 3) {
        this.carry(motion, factor, height, this.rest[i], this.rest[i + 1], this.rest[i + 2] - height);
        place.array[i] = this.point.x;
        place.array[i + 1] = this.point.y;
        place.array[i + 2] = this.point.z;
      }
    });
    place.needsUpdate = true;
    this.wall.geometry.computeVertexNormals();
    const last = motions.length - 1;
    this.seat(this.rna, this.carry(motions[last], factor, modes.height[last], 0, 0, 0));
    this.showDampers(factor);
    this.showSprings(factor);
  }

  seat(part, point) {
    part.position.copy(point);
    part.quaternion.copy(this.turn);
    part.updateMatrix();
  }

  showDampers(factor) {
    this.dampers.forEach((damper, d) => {
      const motion = modes.damper_motion[this.mode][d], stroke = modes.damper_stroke[this.mode][d];
      this.turnAs(motion, factor);
      this.seat(damper, this.carry(motion, factor, modes.damper_height[d], ...stroke.map(part => factor * part)));
    });
  }

  // A symbol lies along x about its middle; it is never turned over, so that it does not flicker.
  showSprings(factor) {
    this.springs.forEach((spring, s) => {
      const motion = modes.spring_motion[this.mode][s], anchor = modes.spring_anchor[this.mode][s];
      this.turnAs(motion, factor);
      const end = this.carry(motion, factor, modes.spring_height[s], ...modes.spring_offset[this.mode][s]);
      const along = this.axis.set(...anchor).negate().add(end), length = along.length();
      along.multiplyScalar(Math.sign(along.x + along.y + along.z) / length);
      spring.quaternion.setFromUnitVectors(spring.position.set(1, 0, 0), along);
      spring.scale.set(length, 1, 1);
      spring.position.set(...anchor).add(end).multiplyScalar(0.5);
      spring.updateMatrix();
    });
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
