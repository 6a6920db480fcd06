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

  // What moves: dashed where it was at the start, whole where it is at the end, and its way between.
  function moving() {
    return scene.moving.map(([from, to, r]) => {
      const [[x, y], [u, v]] = [place(from), place(to)];
      const ring = `stroke="#5f6b78" stroke-width="1.2"`;
      return `<circle cx="${x}" cy="${y}" r="${r * scale}" fill="none" ${ring} stroke-dasharray="4 3"/>` +
        `<circle cx="${u}" cy="${v}" r="${r * scale}" fill="url(#sphere)" ${ring}/>` +
        line([from, to], "#5f6b78", 1.2, `stroke-dasharray="4 3"`) +
        `<circle cx="${u}" cy="${v}" r="2.4" fill="#5f6b78"/>`;
    }).join("");
  }

  // The number of spheres, sorted from far to near, that are painted before the point.
  function layer(p, spheres) {
    for (let k = 0; k < spheres.length; k++) {
      const r = 0.985 * spheres[k][1], d = minus(p, spheres[k][0]);
      const off = dot(right, d) ** 2 + dot(up, d) ** 2;
      if (off < r * r && dot(toward, d) < Math.sqrt(r * r - off)) return k;
    }
    return spheres.length;
  }

  function draw() {
    look();
    const spheres = [...scene.spheres].sort((a, b) => dot(toward, a[0]) - dot(toward, b[0]));
    const layers = Array.from({ length: spheres.length + 1 }, () => "");
    layers[layer([0, 0, 0], spheres)] += base();
    for (const [colour, wide, points] of [...scene.path].sort((a, b) => a[1] - b[1])) {
      let from = 0, depth = layer(points[0], spheres);
      for (let k = 1; k < points.length; k++) {
        const next = layer(points[k], spheres);
        if (next === depth && k < points.length - 1) continue;
        layers[depth] += line(points.slice(from, k + 1), colour, wide ? 3.4 : 1.9);
        [from, depth] = [k, next];
      }
    }
    scene.targets.forEach(([p, r], nth) => {
      const [x, y] = place(p);
      layers[layer(p, spheres)] +=
        `<circle cx="${x}" cy="${y}" r="${Math.max(3, r * scale)}" fill="none" stroke="#1f2328"/>` +
        text(p, nth + 1, -16);
    });
    spheres.forEach(([p, r], k) => {
      const [x, y] = place(p);
      layers[k] += `<circle cx="${x}" cy="${y}" r="${r * scale}" fill="url(#sphere)" stroke="#5f6b78"/>`;
    });
    const start = place(scene.path[0][2][0]);
    layers[spheres.length] += `<circle cx="${start[0]}" cy="${start[1]}" r="4" fill="#fff" ` +
      `stroke="#1f2328" stroke-width="1.8"/>` + text(scene.path[0][2][0], "start", -12);
    const defs = still.slice(still.indexOf("<defs>"), still.indexOf("</defs>") + 7);
    svg.innerHTML = defs + floor() + moving() + layers.join("") + legend;
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
