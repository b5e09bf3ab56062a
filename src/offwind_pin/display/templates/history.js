// Puts the meshes where frames and the time between them have them. Heights are z; the viewer turns
// everything so that z is up.
class Player {
  constructor(viewer) {
    this.viewer = viewer;
    this.displacement = new Float32Array(bytes(motion.displacement).buffer);
    this.sea = motion.sea === null ? null : new Int16Array(bytes(motion.sea).buffer);
    this.wall = this.mesh("structure", "wall");
    this.rest = this.wall.geometry.attributes.position.array.slice();
    this.places = this.wallPlaces();
    this.rna = this.group("structure", "rna");
    if (this.sea) {
      this.surface = this.mesh("sea", "surface");
      this.sides = this.mesh("sea", "sides");
      this.points = this.surface.geometry.attributes.position.count;
    }
    for (const part of [this.wall, this.surface, this.sides]) if (part) part.frustumCulled = false;
    this.first = motion.time[0];
    this.length = motion.time[motion.time.length - 1] - this.first;
    this.bending = new Uint16Array(bytes(motion.bending).buffer);
    this.soil = new Float32Array(bytes(motion.soil_force).buffer);
    this.soilArrows = motion.soil_height.map((_, k) => this.group("arrows", "soil", String(k)));
    this.soilPlaces = motion.soil_height.map(height => this.placeAt(height));
    this.topArrow = motion.top_force === null ? null : this.group("arrows", "top");
    this.coloured = true;
    this.speed = 1;
    this.now = 0;
    this.playing = true;
    this.factor = 1;
    this.last = null;
  }

  mesh(...path) {
    return this.viewer.scene_tree.find(["meshcat", ...path, "<object>"]).object;
  }

  group(...path) {
    return this.viewer.scene_tree.find(["meshcat", ...path]).object;
  }

  // The point of the axis below a height, and the share of the way to the next.
  placeAt(height) {
    const heights = motion.height;
    let k = 0;
    while (k < heights.length - 2 && heights[k + 1] <= height) ++k;
    const share = (height - heights[k]) / (heights[k + 1] - heights[k]);
    return [k, Math.min(Math.max(share, 0), 1)];
  }

  wallPlaces() {
    const places = [];
    for (let i = 2; i < this.rest.length; i += 3) places.push(this.placeAt(this.rest[i]));
    return places;
  }

  // Frame before a time in s from the start, and the share of the way to the next one.
  frame(now) {
    const time = motion.time;
    let k = Math.min(Math.floor(now / this.length * (time.length - 1)), time.length - 2);
    while (k > 0 && time[k] - this.first > now) --k;
    while (k < time.length - 2 && time[k + 1] - this.first <= now) ++k;
    return [k, (now + this.first - time[k]) / (time[k + 1] - time[k])];
  }

  axis(k, share) {
    const size = 3 * motion.height.length, moved = new Float32Array(size);
    for (let i = 0; i < size; ++i) {
      const before = this.displacement[k * size + i], after = this.displacement[(k + 1) * size + i];
      moved[i] = this.factor * (before + share * (after - before));
    }
    return moved;
  }

  show(now) {
    this.now = now;
    const [k, share] = this.frame(now);
    const moved = this.axis(k, share);
    this.showStructure(moved);
    this.showBending(k, share);
    this.showSoil(k, share, moved);
    this.showTop(k, share);
    if (this.sea) this.showSea(k, share);
    this.viewer.set_dirty();
    return [k, share];
  }

  showStructure(moved) {
    const place = this.wall.geometry.attributes.position, n = motion.height.length;
    this.places.forEach(([k, share], i) => {
      for (let j = 0; j < 3; ++j) {
        const low = moved[3 * k + j], high = moved[3 * k + 3 + j];
        place.array[3 * i + j] = this.rest[3 * i + j] + low + share * (high - low);
      }
    });
    place.needsUpdate = true;
    const top = i => moved.slice(3 * (n - 1 - i), 3 * (n - i)), end = top(0), before = top(1);
    const rise = motion.height[n - 1] - motion.height[n - 2];
    this.rna.position.set(end[0], end[1], motion.height[n - 1] + end[2]);
    const up = this.rna.position.clone().set(0, 0, 1);
    const along = up.clone().set(end[0] - before[0], end[1] - before[1], rise).normalize();
    this.rna.quaternion.setFromUnitVectors(up, along);
    this.rna.updateMatrix();
  }

  showBending(k, share) {
    const colour = this.wall.geometry.attributes.color, n = motion.height.length;
    this.places.forEach(([node, way], i) => {
      const at = frame => {
        const low = this.bending[frame * n + node], high = this.bending[frame * n + node + 1];
        return low + way * (high - low);
      };
      const size = (at(k) + share * (at(k + 1) - at(k))) / 65535;
      const shown = this.coloured ? motion.ramp[Math.round(size * (motion.ramp.length - 1))] : motion.plain;
      for (let j = 0; j < 3; ++j) colour.array[3 * i + j] = shown[j];
    });
    colour.needsUpdate = true;
  }

  // An arrow from a place, a distance away from it, along and as long as a vector.
  point(arrow, place, vector, away) {
    const up = arrow.position.clone().set(0, 0, 1), along = up.clone().set(...vector);
    const length = along.length();
    arrow.visible = length > 0.15;
    if (!arrow.visible) return;
    along.multiplyScalar(1 / length);
    arrow.quaternion.setFromUnitVectors(up, along);
    arrow.scale.set(1, 1, length);
    arrow.position.set(...place).addScaledVector(along, away);
    arrow.updateMatrix();
  }

  showSoil(k, share, moved) {
    const n = motion.soil_height.length;
    this.soilArrows.forEach((arrow, node) => {
      const [below, way] = this.soilPlaces[node], place = [0, 0, motion.soil_height[node]];
      const vector = [0, 0, 0];
      for (let j = 0; j < 3; ++j) {
        const low = moved[3 * below + j], high = moved[3 * below + 3 + j];
        place[j] += low + way * (high - low);
        const before = this.soil[3 * (k * n + node) + j], after = this.soil[3 * ((k + 1) * n + node) + j];
        vector[j] = before + share * (after - before);
      }
      this.point(arrow, place, vector, motion.soil_radius);
    });
  }

  showTop(k, share) {
    if (!this.topArrow) return;
    const vector = motion.top_force[k].map((before, j) => before + share * (motion.top_force[k + 1][j] - before));
    const place = this.rna.position.toArray(), length = motion.top_length;
    this.point(this.topArrow, place, vector.map(part => part * length), 0);
    const tag = element("load");
    tag.textContent = Math.hypot(...vector).toFixed(2) + "\u00a0MN";
    placeTag(this.viewer, tag, this.topArrow.visible ? place.map((part, j) => part + 1.3 * length * vector[j]) : null);
  }

  showSea(k, share) {
    const colour = this.surface.geometry.attributes.color, [low, mean, high] = motion.colours;
    const surface = this.surface.geometry.attributes.position, sides = this.sides.geometry.attributes.position;
    for (let i = 0; i < this.points; ++i) {
      const before = this.sea[k * this.points + i], after = this.sea[(k + 1) * this.points + i];
      const height = before + share * (after - before), size = Math.abs(height) / 32767;
      surface.array[3 * i + 2] = motion.level + motion.unit * height;
      const end = height > 0 ? high : low;
      for (let j = 0; j < 3; ++j) colour.array[3 * i + j] = mean[j] + size * (end[j] - mean[j]);
    }
    motion.rim.forEach((point, i) => { sides.array[3 * i + 2] = surface.array[3 * point + 2]; });
    surface.needsUpdate = colour.needsUpdate = sides.needsUpdate = true;
    this.surface.geometry.computeVertexNormals();
  }

  tick(stamp) {
    if (this.playing && this.last !== null) {
      showAt((this.now + this.speed * (stamp - this.last) / 1000) % this.length);
    }
    this.last = stamp;
    requestAnimationFrame(next => this.tick(next));
  }
}

function showAt(now) {
  const [k, share] = player.show(now);
  const between = values => values[k] + share * (values[k + 1] - values[k]);
  const text = (value, digits, unit) => minus(value.toFixed(digits)) + "\u00a0" + unit;
  element("now").textContent = text(player.first + now, 1, "s");
  if (element("surface")) element("surface").textContent = text(between(motion.elevation), 2, "m");
  element("moment").textContent = text(between(motion.moment.map(row => row[1])), 0, "MN\u00a0m");
  element("time").value = now / player.length;
  for (const cursor of document.querySelectorAll(".cursor")) {
    const x = now / player.length * cursor.ownerSVGElement.viewBox.baseVal.width;
    cursor.setAttribute("x1", x);
    cursor.setAttribute("x2", x);
  }
}

var viewer = null, player = null;
try {
  viewer = new MeshCat.Viewer(element("scene"));
} catch (error) {
  element("pause").replaceWith("This browser offers no WebGL, which the picture needs.");
}
if (viewer) {
  placeCamera(viewer);
  for (const command of commands) viewer.handle_command_bytearray(bytes(command));
  player = new Player(viewer);
  player.factor = Number(element("factor").value);
  element("speed").onchange = event => { player.speed = Number(event.target.value); };
  element("colour").onchange = event => {
    player.coloured = event.target.checked;
    showAt(player.now);
  };
  element("pause").onclick = () => {
    player.playing = !player.playing;
    element("pause").textContent = player.playing ? "Pause" : "Play";
  };
  element("time").oninput = event => showAt(Math.min(Number(event.target.value), 0.999999) * player.length);
  element("factor").onchange = event => {
    player.factor = Number(event.target.value);
    showAt(player.now);
  };
  showAt(0);
  player.tick(null);
}
