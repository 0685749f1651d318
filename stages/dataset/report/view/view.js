// The 3-D view of a press, a grasp or a scene: fronts of gels, their rims and objects, frame by frame, in plain WebGL 2. Runs from
// disk: a classic script, whose data come as another one (view/<id>.js), because a page opened from disk may fetch nothing.
// Everything is drawn where its pose puts it in the world, or as one gel sees it from its own frame S; in metres, z up on
// the screen. Layout of the data: view_data.h.
"use strict";
(() => {
  const element = id => document.getElementById(id);
  const canvas = element("scene");
  let key, data, scene, gl;
  let frame = 0, playing = 0, waiting = false;
  let seen = -1;  // the gel in whose frame one looks; -1: the world
  const home = {azimuth: 0, elevation: 0, distance: 1, target: [0, 0, 0]};
  const camera = {...home};

  function fail(why) {
    element("failure").hidden = false;
    element("stage").hidden = true;
    element("why").textContent = why;
    element("pictures").href = "index.html#" + key;
  }

  // --- Data ---------------------------------------------------------------------------------------------------------

  async function inflated(base64) {
    const text = atob(base64), packed = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // Signed integers as three planes of bytes, lowest first; 0, -1, 1, -2 … are stored as 0, 1, 2, 3 …
  function integers(bytes) {
    let at = 0;
    return count => {
      const values = new Int32Array(count);
      for (let i = 0; i < count; ++i) {
        const z = bytes[at + i] | bytes[at + count + i] << 8 | bytes[at + 2 * count + i] << 16;
        values[i] = z >>> 1 ^ -(z & 1);
      }
      at += 3 * count;
      return values;
    };
  }

  function summed(values) {
    for (let i = 1; i < values.length; ++i) values[i] += values[i - 1];
    return values;
  }

  // One axis after the other; each vertex as the difference from the one before it.
  function points(next, count, before, grid) {
    const whole = before ? Int32Array.from(before) : new Int32Array(3 * count), metres = new Float32Array(3 * count);
    for (let c = 0; c < 3; ++c) {
      const steps = before ? next(count) : summed(next(count));
      for (let v = 0; v < count; ++v) {
        whole[3 * v + c] += steps[v];
        metres[3 * v + c] = grid.low_m[c] + grid.step_m * whole[3 * v + c];
      }
    }
    return {whole, metres};
  }

  function triangles(next, count) {
    const first = summed(next(count)), second = next(count), third = next(count), corners = new Uint32Array(3 * count);
    for (let t = 0; t < count; ++t) corners.set([first[t], first[t] + second[t], first[t] + third[t]], 3 * t);
    return corners;
  }

  function decoded(bytes) {
    const next = integers(bytes);
    const gels = data.gels.map(gel => {
      const corners = triangles(next, gel.triangles), frames = [];
      let before = null;
      for (let f = 0; f < data.frames.length; ++f) {
        const {whole, metres} = points(next, gel.vertices, before, gel.grid);
        before = whole;
        frames.push({positions: metres, pressure: next(gel.vertices), state: next(gel.vertices)});
      }
      return {...gel, corners, frames, rest: frames[0].positions};
    });
    const objects = data.objects.map(object => {
      const corners = triangles(next, object.triangles), frames = [];
      let before = null;
      for (let f = 0; f < (object.kind === "soft" ? data.frames.length : 1); ++f) {
        const {whole, metres} = points(next, object.vertices, before, object.grid);
        before = whole;
        frames.push(metres);
      }
      return {...object, corners, frames};
    });
    return {gels, objects};
  }

  function normalsOf(positions, corners) {
    const normals = new Float32Array(positions.length);
    for (let t = 0; t < corners.length; t += 3) {
      const a = 3 * corners[t], b = 3 * corners[t + 1], c = 3 * corners[t + 2];
      const ux = positions[b] - positions[a], uy = positions[b + 1] - positions[a + 1], uz = positions[b + 2] - positions[a + 2];
      const vx = positions[c] - positions[a], vy = positions[c + 1] - positions[a + 1], vz = positions[c + 2] - positions[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      for (const i of [a, b, c]) {
        normals[i] += x;
        normals[i + 1] += y;
        normals[i + 2] += z;
      }
    }
    return normals;
  }

  // Edges of the front that one triangle alone has, as pairs of vertices: where the gel's side begins.
  function rimOf(corners) {
    const edges = new Map();
    for (let t = 0; t < corners.length; ++t) {
      const a = corners[t], b = corners[t % 3 === 2 ? t - 2 : t + 1];
      const name = Math.min(a, b) * 16777216 + Math.max(a, b);
      if (!edges.delete(name)) edges.set(name, [a, b]);
    }
    return [...edges.values()];
  }

  function wallsOf(positions, rim, rest, bottom) {
    const walls = new Float32Array(18 * rim.length);
    rim.forEach(([a, b], i) => {
      const top = v => [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
      const below = v => [rest[3 * v], rest[3 * v + 1], bottom];
      walls.set([...top(a), ...below(a), ...below(b), ...top(a), ...below(b), ...top(b)], 18 * i);
    });
    return walls;
  }

  // --- Drawing ------------------------------------------------------------------------------------------------------

  const GEL_VERTEX = `#version 300 es
    in vec3 position, normal, looks; in vec2 rest;
    uniform mat4 clip, view; out vec3 v_normal, v_looks, v_place; out vec2 v_rest;
    void main() {
      v_normal = mat3(view) * normal; v_looks = looks; v_rest = rest; v_place = (view * vec4(position, 1)).xyz;
      gl_Position = clip * vec4(position, 1);
    }`;
  // `looks`: 0 to 1 of the colour bar, and how much of the surface sticks and slips. mode 0: bar, 1: states, 2: plain.
  const GEL_FRAGMENT = `#version 300 es
    precision highp float;
    in vec3 v_normal, v_looks, v_place; in vec2 v_rest;
    uniform sampler2D bar; uniform int mode; uniform bool lines, faceted; uniform vec4 plain; uniform vec3 sticks, slips;
    out vec4 color;
    void main() {
      vec3 n = normalize(faceted ? cross(dFdx(v_place), dFdy(v_place)) : v_normal);
      vec3 eye = normalize(-v_place);
      if (dot(n, eye) < 0.) n = -n;
      vec3 base = plain.rgb;
      if (mode == 0) base = texture(bar, vec2(v_looks.x * (255. / 256.) + .5 / 256., .5)).rgb;
      if (mode == 1 && v_looks.y + v_looks.z > .5) base = v_looks.y >= v_looks.z ? sticks : slips;
      if (lines) {
        vec2 mm = v_rest * 1000., away = abs(fract(mm - .5) - .5) / fwidth(mm);
        float line = 1. - min(min(away.x, away.y), 1.);
        base = mix(base, vec3(mode == 0 ? 1. : 0.), .28 * line);
      }
      const vec3 key = normalize(vec3(-.55, .65, .52)), fill = normalize(vec3(.7, -.1, .7));
      float light = .36 + .56 * max(dot(n, key), 0.) + .2 * max(dot(n, fill), 0.);
      float shine = pow(max(dot(n, normalize(key + eye)), 0.), 40.);
      color = vec4(base * light + .22 * shine, plain.a);
      color.rgb *= color.a;
    }`;

  function programOf(vertex, fragment) {
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) || "no shader");
    return program;
  }

  // A mesh on the card: arrays by the names of the shader's inputs; those that are not given are zero.
  function meshOf(program, arrays, corners) {
    const mesh = {array: gl.createVertexArray(), buffers: {}, count: 0, indexed: Boolean(corners)};
    gl.bindVertexArray(mesh.array);
    for (const [name, size] of Object.entries(arrays)) {
      const place = gl.getAttribLocation(program, name);
      mesh.buffers[name] = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers[name]);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
    }
    if (corners) {
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.STATIC_DRAW);
      mesh.count = corners.length;
    }
    return mesh;
  }

  function fill(mesh, name, values) {
    gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers[name]);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    if (!mesh.indexed) mesh.count = values.length / 3;
  }

  function prepared(parts) {
    const program = programOf(GEL_VERTEX, GEL_FRAGMENT), uniforms = {};
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
      const name = gl.getActiveUniform(program, i).name;
      uniforms[name] = gl.getUniformLocation(program, name);
    }
    const gels = parts.gels.map(gel => {
      const front = meshOf(program, {position: 3, normal: 3, looks: 3, rest: 2}, gel.corners);
      fill(front, "rest", gel.rest.filter((_, i) => i % 3 < 2));
      return {...gel, front, walls: meshOf(program, {position: 3}), rim: rimOf(gel.corners)};
    });
    const objects = parts.objects.map(object => {
      const mesh = meshOf(program, {position: 3}, object.corners);
      fill(mesh, "position", object.frames[0]);
      return {...object, mesh};
    });
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    const bar = new Uint8Array(data.colors.flat());
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, bar.length / 3, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, bar);
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
    for (const size of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, size, gl.LINEAR);
    return {program, uniforms, gels, objects};
  }

  function deform(gel) {
    const now = gel.frames[frame], rest = gel.rest, count = rest.length / 3, looks = new Float32Array(3 * count);
    const pressure = element("color").value === "pressure";
    for (let v = 0; v < count; ++v) {
      looks[3 * v] = pressure ? now.pressure[v] / 255 : (rest[3 * v + 2] - now.positions[3 * v + 2]) / data.indentation_m;
      looks[3 * v + 1] = now.state[v] === 1 ? 1 : 0;
      looks[3 * v + 2] = now.state[v] === 2 ? 1 : 0;
    }
    fill(gel.front, "position", now.positions);
    fill(gel.front, "normal", normalsOf(now.positions, gel.corners));
    fill(gel.front, "looks", looks);
    fill(gel.walls, "position", wallsOf(now.positions, gel.rim, rest, gel.bottom_m));
  }

  // The tactile image of each gel that is seen; of a frame that was not rendered, none.
  function showImages() {
    scene.gels.forEach((gel, i) => {
      if (!gel.figure) return;
      const file = gel.pictures[frame], [image, caption] = gel.figure.children;
      gel.figure.hidden = seen >= 0 && seen !== i;
      image.style.visibility = file ? "visible" : "hidden";
      if (file) image.src = file;
      caption.textContent = (gel.name || "tactile image") + (file ? "" : ": this frame was not rendered");
      const next = gel.pictures[(frame + 1) % data.frames.length];
      if (next) new Image().src = next;  // there when it is played
    });
  }

  function showFrame() {
    scene.gels.forEach(deform);
    for (const object of scene.objects) if (object.kind === "soft") fill(object.mesh, "position", object.frames[frame]);
    showImages();
    const facts = data.frames[frame];
    element("facts").textContent = facts.text;
    element("frame").value = frame;
    element("frame").setAttribute("aria-valuetext", facts.text);
    redraw();
  }

  const product = (a, b) => a.map((_, i) => {
    let sum = 0;
    for (let k = 0; k < 4; ++k) sum += a[i % 4 + 4 * k] * b[4 * (i >> 2) + k];
    return sum;
  });

  // Poses are given row by row, the card wants columns.
  const columnsOf = pose => pose.map((_, i) => pose[4 * (i % 4) + (i >> 2)]);

  // The rigid motion back, in columns.
  function inverseOf(pose) {
    const back = c => -(pose[c] * pose[3] + pose[4 + c] * pose[7] + pose[8 + c] * pose[11]);
    return [pose[0], pose[1], pose[2], 0, pose[4], pose[5], pose[6], 0, pose[8], pose[9], pose[10], 0, back(0), back(1), back(2), 1];
  }

  // Where a part of the scene is in a frame, for the eye that looks, in columns.
  function placeOf(part, f) {
    const place = columnsOf(part.poses[f]);
    return seen < 0 ? place : product(inverseOf(scene.gels[seen].poses[f]), place);
  }

  function cameraMatrices() {
    const {azimuth, elevation, distance, target} = camera;
    const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
    const right = [-sa, ca, 0], back = [ca * ce, sa * ce, se], up = [-ca * se, -sa * se, ce];
    const along = axis => -(axis[0] * target[0] + axis[1] * target[1] + axis[2] * target[2]);
    const view = [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
                  along(right), along(up), along(back) - distance, 1];
    const near = distance / 50, far = distance * 6, aspect = canvas.width / canvas.height;
    const zoom = 3.7 * Math.min(1, aspect / 1.25);  // narrow screens still see the whole width
    const lens = [zoom / aspect, 0, 0, 0, 0, zoom, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
    return {view, lens, right, up};
  }

  function paint(mesh, clip, view, looks) {
    const u = scene.uniforms;
    gl.bindVertexArray(mesh.array);
    gl.uniformMatrix4fv(u.clip, false, clip);
    gl.uniformMatrix4fv(u.view, false, view);
    gl.uniform1i(u.mode, looks.mode);
    gl.uniform1i(u.lines, looks.lines ? 1 : 0);
    gl.uniform1i(u.faceted, looks.faceted ? 1 : 0);
    gl.uniform4fv(u.plain, looks.plain);
    const draw = () => mesh.indexed ? gl.drawElements(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0) : gl.drawArrays(gl.TRIANGLES, 0, mesh.count);
    if (looks.plain[3] < 1) {  // only its nearest surface shows: depth first
      gl.colorMask(false, false, false, false);
      draw();
      gl.colorMask(true, true, true, true);
    }
    draw();
  }

  function draw() {
    waiting = false;
    const sharp = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * sharp));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * sharp));
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    for (const state of [gl.DEPTH_TEST, gl.BLEND]) gl.enable(state);
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.useProgram(scene.program);
    gl.uniform3f(scene.uniforms.sticks, .25, .62, .42);
    gl.uniform3f(scene.uniforms.slips, .92, .5, .16);
    const {view, lens} = cameraMatrices(), clip = product(lens, view), mode = element("color").value === "state" ? 1 : 0;
    const put = (part, mesh, looks) => {
      const place = placeOf(part, frame);
      paint(mesh, product(clip, place), product(view, place), looks);
    };
    scene.gels.forEach((gel, i) => {
      if (seen >= 0 && seen !== i) return;
      put(gel, gel.front, {mode, lines: element("lines").checked, plain: [.78, .8, .84, 1]});
      put(gel, gel.walls, {mode: 2, faceted: true, plain: [.9, .92, .95, 1]});
    });
    const looks = {solid: 1, glass: .34, hidden: 0};
    const alphas = {object: looks[element("object").value], robot: seen < 0 ? looks[element("robot").value] : 0};
    // What is solid first: it is to be seen through what is not.
    const shown = scene.objects.map(object => ({object, alpha: object.kind === "robot" ? alphas.robot : alphas.object}));
    for (const {object, alpha} of shown.sort((a, b) => b.alpha - a.alpha)) {
      if (alpha === 0) continue;
      const color = {soft: [.56, .72, .68], fixed: [.66, .68, .72], robot: [.47, .5, .55]}[object.kind] || [.8, .74, .64];
      put(object, object.mesh, {mode: 2, faceted: true, plain: [...color, alpha]});
    }
    canvas.dataset.drawn = [seen < 0 ? key : key + "/" + scene.gels[seen].name, frame, element("color").value, element("object").value].join(" ");
  }

  function redraw() {
    if (!waiting) requestAnimationFrame(draw);
    waiting = true;
  }

  // --- Controls -----------------------------------------------------------------------------------------------------

  const digits = value => Number(value.toPrecision(3)).toString();

  function showBar() {
    const kind = element("color").value, states = kind === "state";
    element("bar").hidden = states;
    element("states").hidden = !states;
    if (states) return;
    const top = kind === "pressure" ? data.pressure_pa / 1e3 : data.indentation_m * 1e3;
    element("unit").textContent = kind === "pressure" ? "normal traction, kPa" : "indentation, mm";
    element("low").textContent = "0";
    element("middle").textContent = digits(top / 2);
    element("high").textContent = (kind === "pressure" ? "≥ " : "") + digits(top);
    element("ramp").style.background = "linear-gradient(90deg, " + data.colors.filter((_, i) => i % 15 === 0).map(c => `rgb(${c})`).join(", ") + ")";
  }

  function play(on) {
    clearInterval(playing);
    playing = on ? setInterval(() => {
      frame = (frame + 1) % data.frames.length;
      showFrame();
    }, 350) : 0;
    element("play").textContent = on ? "Pause" : "Play";
  }

  function turn(dx, dy) {
    camera.azimuth -= dx;
    camera.elevation = Math.max(-1.55, Math.min(1.55, camera.elevation + dy));
    redraw();
  }

  function shift(dx, dy) {
    const {right, up} = cameraMatrices(), metres = camera.distance / (1.85 * canvas.clientHeight);
    for (let c = 0; c < 3; ++c) camera.target[c] += metres * (dy * up[c] - dx * right[c]);
    redraw();
  }

  function zoomBy(factor) {
    camera.distance = Math.max(home.distance / 20, Math.min(home.distance * 4, camera.distance * factor));
    redraw();
  }

  // Far enough away for what is seen: one gel from above its front, or all gels, and of several bodies all that are not
  // fixed or the robot's, wherever they go.
  function goHome() {
    const ends = ({low_m: low, step_m: step, size}) => low.map((from, c) => [from, from + size[c] * step]);
    const bodies = scene.objects.some(object => object.kind) || scene.objects.length !== 1;
    const alone = scene.gels.length === 1 && !bodies ? 0 : seen;
    if (alone >= 0) {
      const [x, y, z] = ends(scene.gels[alone].grid), wide = Math.hypot(x[1] - x[0], y[1] - y[0]);
      Object.assign(home, {target: [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2, z[1] - wide / 30], distance: 1.6 * wide, azimuth: -1.12, elevation: .62});
      return;
    }
    const least = [1e9, 1e9, 1e9], most = [-1e9, -1e9, -1e9];
    const moving = bodies ? scene.objects.filter(object => object.kind !== "fixed" && object.kind !== "robot") : [];
    for (const part of [...scene.gels, ...moving]) {
      const [x, y, z] = ends(part.grid);
      for (let f = 0; f < data.frames.length; ++f) {
        const place = columnsOf(part.poses[f]);
        for (const a of x) for (const b of y) for (const d of [part.bottom_m ?? z[0], z[1]]) {
          for (let c = 0; c < 3; ++c) {
            const at = place[c] * a + place[4 + c] * b + place[8 + c] * d + place[12 + c];
            least[c] = Math.min(least[c], at);
            most[c] = Math.max(most[c], at);
          }
        }
      }
    }
    const sizes = most.map((end, c) => end - least[c]);
    Object.assign(home, {target: most.map((end, c) => (end + least[c]) / 2), distance: 1.75 * Math.hypot(...sizes), azimuth: -1.38, elevation: .25});
  }

  function reset() {
    Object.assign(camera, home, {target: [...home.target]});
    redraw();
  }

  function listenToCanvas() {
    const fingers = new Map();
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    });
    canvas.addEventListener("pointermove", event => {
      const finger = fingers.get(event.pointerId);
      if (!finger) return;
      const dx = event.clientX - finger.x, dy = event.clientY - finger.y, two = fingers.size === 2, before = two ? spread() : 1;
      Object.assign(finger, {x: event.clientX, y: event.clientY});
      if (two) {
        zoomBy(before / Math.max(spread(), 1));
        shift(dx / 2, dy / 2);
      } else if (event.shiftKey || event.buttons & 6) {
        shift(dx, dy);
      } else {
        turn(dx / 180, dy / 180);
      }
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => fingers.delete(event.pointerId));
    canvas.addEventListener("contextmenu", event => event.preventDefault());
    canvas.addEventListener("wheel", event => {
      event.preventDefault();
      zoomBy(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) / 400));
    }, {passive: false});
    canvas.addEventListener("keydown", event => {
      const keys = {ArrowLeft: () => turn(-.1, 0), ArrowRight: () => turn(.1, 0), ArrowUp: () => turn(0, .1), ArrowDown: () => turn(0, -.1),
                    "+": () => zoomBy(.9), "-": () => zoomBy(1 / .9)};
      if (!keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
    });
  }

  function listImages() {
    for (const gel of scene.gels) {
      if (!gel.pictures) continue;
      const image = Object.assign(new Image(), {alt: "tactile image " + gel.name});
      gel.figure = document.createElement("figure");
      gel.figure.append(image, document.createElement("figcaption"));
      element("images").append(gel.figure);
      element("images").hidden = false;
    }
  }

  function look(gel) {
    seen = gel;
    element("seen").value = gel < 0 ? "" : gel;
    goHome();
    reset();
  }

  function listen() {
    listenToCanvas();
    element("of-gels").hidden = scene.gels.length < 2;
    scene.gels.forEach((gel, i) => element("seen").append(new Option(gel.name + ", in its own frame", i)));
    element("seen").addEventListener("change", event => {
      look(event.target.value === "" ? -1 : Number(event.target.value));
      showImages();
    });
    element("frame").max = data.frames.length - 1;
    element("frame").addEventListener("input", event => {
      play(false);
      frame = Number(event.target.value);
      showFrame();
    });
    element("play").addEventListener("click", () => play(!playing));
    element("color").addEventListener("change", () => {
      showBar();
      showFrame();
    });
    element("of-robots").hidden = scene.objects.every(object => object.kind !== "robot");
    for (const id of ["object", "robot", "lines"]) element(id).addEventListener("change", redraw);
    element("reset").addEventListener("click", reset);
    window.addEventListener("resize", redraw);
  }

  // --- Start --------------------------------------------------------------------------------------------------------

  window.tacipc_view = async given => {
    data = given;
    try {
      scene = prepared(decoded(await inflated(data.packed)));
    } catch (error) {
      return fail("The view cannot be shown: " + error.message);
    }
    frame = data.frames.length - 1;
    listen();
    listImages();
    look(scene.gels.findIndex(gel => gel.name && gel.name === location.hash.split("/")[1]));
    showBar();
    showFrame();
  };

  function start() {
    const samples = element("sample"), named = location.hash.slice(1).split("/")[0];
    if ([...samples.options].some(option => option.value === named)) samples.value = named;
    key = samples.value;
    element("back").href = "index.html#" + key;
    samples.addEventListener("change", () => location.hash = samples.value);
    window.addEventListener("hashchange", () => location.reload());
    if (!window.DecompressionStream) return fail("This browser cannot unpack the data (it has no DecompressionStream).");
    gl = canvas.getContext("webgl2", {antialias: true});
    if (!gl) return fail("This browser has no WebGL 2, or it is turned off.");
    const script = document.createElement("script");
    script.src = `view/${key}.js`;
    script.onerror = () => fail(`view/${key}.js is missing.`);
    document.head.append(script);
  }

  start();
})();
