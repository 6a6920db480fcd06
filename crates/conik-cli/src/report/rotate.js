// Drag the picture of the path to turn it. The first drag replaces the static picture by one that
// is projected here; a double click brings the static one back.
(() => {
  const figure = document.getElementById("path");
  const data = document.getElementById("scene");
  const svg = figure && figure.querySelector("svg");
  if (!svg || !data) return;
  const scene = JSON.parse(data.textContent);
  if (!scene.path.length) return;
  const still = svg.innerHTML;
  const legend = svg.lastElementChild.outerHTML;
  const [width, height] = scene.size;
  let [azimuth, elevation] = scene.view;
  let right, up, toward, scale, origin;

  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const place = (p) => [origin[0] + scale * dot(right, p), origin[1] - scale * dot(up, p)];
  const to = (p) => place(p).map((v) => v.toFixed(1)).join(" ");
  const middle = scene.low.map((v, k) => (v + scene.high[k]) / 2);

  function look() {
    const a = (azimuth * Math.PI) / 180, e = (elevation * Math.PI) / 180;
    right = [-Math.sin(a), Math.cos(a), 0];
    up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
    toward = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
    const size = minus(scene.high, scene.low);
    scale = (0.92 * Math.min(width, height - 40)) / Math.hypot(...size);
    origin = [width / 2 - scale * dot(right, middle), (height - 30) / 2 + scale * dot(up, middle)];
  }

  const line = (points, colour, thick, more = "") =>
    `<path d="M${points.map(to).join("L")}" fill="none" stroke="${colour}" ` +
    `stroke-width="${thick}" stroke-linejoin="round" stroke-linecap="round" ${more}/>`;
  const text = (p, words, dy = 0) => {
    const [x, y] = place(p);
    return `<text x="${x.toFixed(1)}" y="${(y + 4 + dy).toFixed(1)}" font-size="11" ` +
      `text-anchor="middle" fill="#57606a">${words}</text>`;
  };

  function floor() {
    const [low, high, z] = [scene.low, scene.high, scene.low[2]];
    let out = "";
    for (let x = low[0]; x < high[0] + scene.step / 2; x += scene.step)
      out += line([[x, low[1], z], [x, high[1], z]], "#dfe4e9", 0.8);
    for (let y = low[1]; y < high[1] + scene.step / 2; y += scene.step)
      out += line([[low[0], y, z], [high[0], y, z]], "#dfe4e9", 0.8);
    for (const [, , points] of scene.path)
      out += line(points.map((p) => [p[0], p[1], z]), "#c3cad2", 1.3);
    return out;
  }

  function base() {
    if (!scene.base) return "";
    const size = 0.16 * Math.max(scene.high[0] - scene.low[0], scene.high[1] - scene.low[1]);
    return ["x", "y", "z"].map((name, k) => {
      const tip = [0, 0, 0], word = [0, 0, 0];
      tip[k] = size;
      word[k] = 1.2 * size;
      return line([[0, 0, 0], tip], "#1f2328", 1.4) + text(word, name);
    }).join("");
  }

  const cross = (a, b) =>
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const plus = (a, b) => a.map((v, k) => v + b[k]);
  const ring = (n, at) => Array.from({ length: n }, (_, k) => at(k));
  const BOX = [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]];

  // The faces of what has corners; the caps of a cylinder come first.
  function faces({ kind, points }) {
    if (kind === "box") return BOX;
    const n = points.length / 2;
    const sides = ring(n, (k) => [k, (k + 1) % n, n + ((k + 1) % n), n + k]);
    return [ring(n, (k) => k), ring(n, (k) => n + k), ...sides];
  }

  function solid([kind, gradient, plain, edge, radius, points], away) {
    points = away ? points.map((p) => minus(p, away)) : points;
    const sum = points.reduce(plus, [0, 0, 0]);
    const it = { kind, gradient, plain, edge, radius, points, centre: sum.map((v) => v / points.length) };
    it.faces = radius ? [] : faces(it).map((corners) => {
      const [a, b, c] = [corners[0], corners[1], corners[corners.length - 1]].map((k) => points[k]);
      const normal = cross(minus(b, a), minus(c, a));
      const out = Math.sign(dot(normal, minus(a, it.centre))) || 1;
      return { corners: corners.map((k) => points[k]), normal: normal.map((v) => out * v) };
    });
    return it;
  }

  // The hull of points on paper.
  function hull(points) {
    points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const chain = (list) => {
      const out = [];
      for (const c of list) {
        while (out.length > 1) {
          const [a, b] = out.slice(-2);
          if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) break;
          out.pop();
        }
        out.push(c);
      }
      return out.slice(0, -1);
    };
    return [...chain(points), ...chain([...points].reverse())];
  }

  const area = (places, fill, edge, opacity, more = "") =>
    `<path d="M${places.map((p) => p.map((v) => v.toFixed(1)).join(" ")).join("L")}Z" fill="${fill}" ` +
    `fill-opacity="${opacity}" stroke="${edge}" stroke-width="0.9" stroke-linejoin="round" ${more}/>`;

  function paint(it, opacity, more) {
    const { kind, gradient, plain, edge, radius, points } = it;
    if (kind === "ball") {
      const [x, y] = place(points[0]);
      return `<circle cx="${x}" cy="${y}" r="${radius * scale}" fill="url(#ball-${gradient})" ` +
        `fill-opacity="${opacity}" stroke="${edge}" stroke-width="0.9" ${more}/>`;
    }
    const round = (p) => ring(24, (k) => {
      const [x, y] = place(p), a = (k * Math.PI) / 12;
      return [x + scale * radius * Math.cos(a), y + scale * radius * Math.sin(a)];
    });
    const shown = it.faces.slice(0, kind === "box" ? 6 : 2).filter((f) => dot(f.normal, toward) > 0);
    const seen = shown.map((f) => area(f.corners.map(place), plain, edge, 0.5 * opacity, more)).join("");
    return area(hull(points.flatMap(radius ? round : (p) => [place(p)])), plain, edge, opacity, more) + seen;
  }

  const within = (p, places) => {
    let inside = false;
    places.forEach(([x, y], k) => {
      const [u, v] = places[(k + 1) % places.length];
      if (y > p[1] !== v > p[1] && p[0] < x + ((p[1] - y) * (u - x)) / (v - y)) inside = !inside;
    });
    return inside;
  };

  // Whether the solid stands between the viewer and the point.
  function hides(it, p) {
    if (it.radius) {
      const r = 0.985 * it.radius, [from, to] = [it.points[0], it.points[it.points.length - 1]];
      return ring(it.points.length > 1 ? 12 : 1, (k) => k / 11).some((part) => {
        const d = minus(p, from.map((v, k) => v + part * (to[k] - v)));
        const off = dot(right, d) ** 2 + dot(up, d) ** 2;
        return off < r * r && dot(toward, d) < Math.sqrt(r * r - off);
      });
    }
    return it.faces.some(({ corners, normal }) => {
      const facing = dot(normal, toward);
      return facing > 0 && dot(minus(corners[0], p), normal) / facing > 1e-4 &&
        within(place(p), corners.map(place));
    });
  }

  function layer(p, solids) {
    const first = solids.findIndex((it) => !it.moves && hides(it, p));
    return first < 0 ? solids.length : first;
  }

  const way = (from, to) =>
    line([from, to], "#5f6b78", 1.2, `stroke-dasharray="4 3"`);

  function surroundings(inFront) {
    return scene.walls.map(([fill, edge, normal, corners]) =>
      corners.length < 3 || dot(normal, toward) < 0 !== inFront ? "" :
        area(corners.map(place), fill, edge, inFront ? 0.08 : 0.26, inFront ? `stroke-dasharray="5 3"` : "")
    ).join("");
  }

  function draw() {
    look();
    const solids = scene.solids.map((data) => ({ ...solid(data), moves: data[6] }))
      .sort((a, b) => dot(toward, a.centre) - dot(toward, b.centre));
    const layers = Array.from({ length: solids.length + 1 }, () => "");
    layers[layer([0, 0, 0], solids)] += base();
    for (const [colour, wide, points] of [...scene.path].sort((a, b) => a[1] - b[1])) {
      let from = 0, depth = layer(points[0], solids);
      for (let k = 1; k < points.length; k++) {
        const next = layer(points[k], solids);
        if (next === depth && k < points.length - 1) continue;
        layers[depth] += line(points.slice(from, k + 1), colour, wide ? 3.4 : 1.9);
        [from, depth] = [k, next];
      }
    }
    scene.targets.forEach(([p, r], nth) => {
      const [x, y] = place(p);
      layers[layer(p, solids)] +=
        `<circle cx="${x}" cy="${y}" r="${Math.max(3, r * scale)}" fill="none" stroke="#1f2328"/>` +
        text(p, nth + 1, -16);
    });
    solids.forEach((it, k) => { layers[k] += paint(it, 0.78, ""); });
    let things = "";
    for (const data of scene.solids.filter((data) => data[6])) {
      const { centre } = solid(data);
      things += paint(solid(data, data[6]), 0.2, `stroke-dasharray="4 3"`) + way(minus(centre, data[6]), centre);
    }
    for (const [p, r] of scene.bounds) {
      const [x, y] = place(p);
      things += `<circle cx="${x}" cy="${y}" r="${r * scale}" fill="none" stroke="#57606a" stroke-dasharray="6 4"/>`;
    }
    for (const edge of scene.cells) things += line(edge, "#57606a", 1.2, `stroke-dasharray="6 4"`);
    for (const [to, , from] of scene.targets) things += way(from, to);
    for (const [from, to] of scene.sights) {
      const [x, y] = place(to);
      things += way(from, to) + `<path d="M${x - 7} ${y}h14M${x} ${y - 7}v14" stroke="#1f2328"/>`;
    }
    const start = place(scene.path[0][2][0]);
    layers[solids.length] += `<circle cx="${start[0]}" cy="${start[1]}" r="4" fill="#fff" ` +
      `stroke="#1f2328" stroke-width="1.8"/>` + text(scene.path[0][2][0], "start", -12);
    const defs = still.slice(still.indexOf("<defs>"), still.indexOf("</defs>") + 7);
    svg.innerHTML = defs + floor() + surroundings(false) + things + layers.join("") + surroundings(true) + legend;
  }

  figure.classList.add("turnable");
  const hint = document.createElement("figcaption");
  hint.textContent = "Drag to turn; double-click for the original view.";
  figure.append(hint);
  let last = null;
  svg.addEventListener("pointerdown", (event) => {
    last = [event.clientX, event.clientY];
    svg.setPointerCapture(event.pointerId);
  });
  svg.addEventListener("pointermove", (event) => {
    if (!last) return;
    azimuth -= (event.clientX - last[0]) * 0.5;
    elevation = Math.min(89, Math.max(-20, elevation + (event.clientY - last[1]) * 0.5));
    last = [event.clientX, event.clientY];
    draw();
  });
  const release = () => { last = null; };
  svg.addEventListener("pointerup", release);
  svg.addEventListener("pointercancel", release);
  svg.addEventListener("dblclick", () => {
    [azimuth, elevation] = scene.view;
    svg.innerHTML = still;
  });
})();
