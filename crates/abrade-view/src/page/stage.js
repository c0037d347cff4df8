// The view in three dimensions. Lengths are divided by the size of what is shown: a renderer's
// depths are of little digits.

const BODY_COLOUR = 0x6f8fb4;
/** Opacity of bodies that never move, such as floors and lids: they would hide what they enclose. */
const AT_REST = 0.14;
/** Triangles above which bodies are drawn with flat faces: to round them takes a search. */
const ROUNDED = 200_000;

/** Paths above which they are drawn faintly. */
const MANY = 12;
/** Room around the surfaces, as a factor. */
const MARGIN_OF_VIEW = 1.12;

class Stage {
  constructor(canvas, run) {
    this.run = run;
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.localClippingEnabled = true;
    const bounds = boundsOf(run.surfaces);
    this.low = bounds.low;
    this.high = bounds.high;
    this.size = Math.hypot(...[0, 1, 2].map((i) => bounds.high[i] - bounds.low[i])) || 1;
    this.middle = [0, 1, 2].map((i) => (bounds.low[i] + bounds.high[i]) / 2);
    this.scene = new THREE.Scene();
    this.root = new THREE.Group();
    this.root.scale.setScalar(1 / this.size);
    this.root.position.set(...this.middle.map((value) => -value / this.size));
    this.scene.add(this.root);
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xd8d8d8, 2.05));
    this.lamp = new THREE.DirectionalLight(0xffffff, 1.35);
    this.scene.add(this.lamp);
    this.clip = new THREE.Plane(new THREE.Vector3(0, 1, 0), 0);
    this.uniforms = { exaggeration: { value: 1 }, largest: { value: run.maxDepth || 1 }, colours: { value: colourTexture(run.colours) } };
    this.objects = [];
    this.pathMaterial = new THREE.LineBasicMaterial({ depthTest: false, transparent: true });
    this.addSurfaces();
    this.addBodies();
    this.addPlane();
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.render());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  addSurfaces() {
    for (const surface of this.run.surfaces) {
      const object = { solid: surface, nameOf: () => surface.name, material: this.surfaceMaterial(), meshes: [] };
      this.objects.push(object);
      this.layOut(object, surface.shapes[0]);
      const isSame = surface.shapes.every((shape) => shape.parts === surface.shapes[0].parts);
      this.addPaths(object, isSame ? [] : null);
    }
  }

  /** Makes the meshes of a surface anew, for another shape. */
  layOut(object, shape) {
    for (const mesh of object.meshes) {
      this.root.remove(mesh);
      mesh.geometry.dispose();
    }
    const isVisible = object.meshes[0]?.visible ?? true;
    object.shape = shape;
    object.depth = new THREE.BufferAttribute(new Float32Array(shape.points), 1);
    const attributes = { position: new THREE.BufferAttribute(shape.local, 3), normal: new THREE.BufferAttribute(shape.normal, 3), depth: object.depth };
    object.meshes = trianglesOfParts(shape).map((triangles) => this.mesh(attributes, triangles, object.material));
    for (const mesh of object.meshes) mesh.visible = isVisible;
  }

  /** Lit, coloured by depth, its nodes moved inward by the depth times the exaggeration. */
  surfaceMaterial() {
    const material = new THREE.MeshLambertMaterial({ flatShading: true, side: THREE.DoubleSide });
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = `attribute float depth; uniform float exaggeration; varying float vDepth;\n${shader.vertexShader}`
        .replace("#include <begin_vertex>", "vec3 transformed = position - normal * depth * exaggeration; vDepth = depth;");
      shader.fragmentShader = `uniform float largest; uniform sampler2D colours; varying float vDepth;\n${shader.fragmentShader}`
        .replace("#include <color_fragment>", "float share = clamp(vDepth / largest, 0.0, 1.0);\n" +
          "diffuseColor.rgb = vDepth > 0.0 ? texture2D(colours, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb : vec3(0.81, 0.82, 0.84);");
    };
    return material;
  }

  addBodies() {
    const { bodies, times } = this.run;
    if (!bodies) return;
    const [shape] = bodies.shapes;
    const radii = radiiOfParts(shape);
    const position = new THREE.BufferAttribute(shape.local, 3);
    const rounded = shape.triangles.length / 3 <= ROUNDED;
    const materials = [1, AT_REST].map((opacity) => new THREE.MeshLambertMaterial({ color: BODY_COLOUR, opacity, transparent: opacity < 1, depthWrite: opacity === 1, flatShading: !rounded, polygonOffset: opacity < 1, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }));
    const meshes = trianglesOfParts(shape).map((triangles, body) => {
      const rests = times.length > 1 && isAtRest(bodies, body, radii[body]);
      return this.mesh({ position }, triangles, materials[rests ? 1 : 0], rounded);
    });
    const object = { solid: bodies, shape, nameOf: (body) => bodies.names[body], meshes };
    this.objects.push(object);
    this.addPaths(object, bodies.paths);
  }

  mesh(attributes, triangles, material, rounded = false) {
    let geometry = new THREE.BufferGeometry();
    for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
    if (rounded) {
      const corners = new Float32Array(3 * triangles.length);
      triangles.forEach((point, i) => corners.set(attributes.position.array.subarray(3 * point, 3 * point + 3), 3 * i));
      geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(corners, 3));
      geometry = THREE.toCreasedNormals(geometry.scale(1 / this.size, 1 / this.size, 1 / this.size), 0.6).scale(this.size, this.size, this.size);
    }
    const mesh = new THREE.Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    this.root.add(mesh);
    return mesh;
  }

  /** A line per part along its way: of `paths`, or through the instants where there is none. */
  addPaths(object, paths) {
    object.lines = [];
    for (let part = 0; paths && part < object.shape.parts; part++) {
      const through = () => Float32Array.from(object.solid.instants.flatMap((instant) => [...poseOf(instant, part).subarray(0, 3)]));
      const points = new THREE.BufferAttribute(paths[part] ?? through(), 3);
      const geometry = new THREE.BufferGeometry().setAttribute("position", points);
      const line = new THREE.Line(geometry, this.pathMaterial);
      line.frustumCulled = false;
      // Over the body whose middle it goes through.
      line.renderOrder = 1;
      this.root.add(line);
      object.lines.push(line);
      if (object.lines.length > MANY) this.pathMaterial.opacity = 0.4;
    }
  }

  /** Shows the instant of this number. */
  show(number) {
    for (const object of this.objects) {
      const instant = object.solid.instants[number];
      if (object.shape !== instant.shape) this.layOut(object, instant.shape);
      object.meshes.forEach((mesh, part) => {
        const [x, y, z, ...q] = poseOf(instant, part);
        mesh.matrix.compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(...q), new THREE.Vector3(1, 1, 1));
        mesh.matrixWorldNeedsUpdate = true;
      });
      object.depth?.array.set(instant.depth);
      if (object.depth) object.depth.needsUpdate = true;
    }
    this.render();
  }

  exaggerate(factor) {
    this.uniforms.exaggeration.value = factor;
    this.render();
  }

  /** Draws what `isShown` names, and the paths if `withPaths`. */
  choose(isShown, withPaths) {
    for (const { nameOf, meshes, lines } of this.objects) {
      meshes.forEach((mesh, part) => {
        mesh.visible = isShown(nameOf(part));
        if (lines[part]) lines[part].visible = mesh.visible && withPaths;
      });
    }
    this.render();
  }

  /** Takes the colours of lines from the page's style. */
  dress() {
    const style = getComputedStyle(document.documentElement);
    this.pathMaterial.color.set(style.getPropertyValue("--path").trim());
    for (const part of this.plane.children) part.material.color.set(style.getPropertyValue("--accent").trim());
    this.render();
  }

  addPlane() {
    this.plane = new THREE.Group();
    const square = new THREE.PlaneGeometry(1, 1);
    const sheet = new THREE.Mesh(square, new THREE.MeshBasicMaterial({ transparent: true, opacity: 0.1, side: THREE.DoubleSide, depthWrite: false }));
    const corners = [[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]].map((corner) => new THREE.Vector3(...corner));
    const border = new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(corners), new THREE.LineBasicMaterial());
    this.knob = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), new THREE.MeshBasicMaterial());
    this.plane.add(sheet, border);
    this.scene.add(this.plane);
    // The knob has a size of its own, whatever the sheet's is.
    this.plane.add(this.knob);
  }

  /** Puts the plane across `axis` at `at` [m] from the page's origin; `opened` cuts these surfaces. */
  setPlane(axis, at, opened) {
    const [across, up] = chartAxes(axis);
    const spans = [0, 1, 2].map((i) => (this.high[i] - this.low[i]) / this.size);
    const room = 0.03;
    const lengths = [across, up].map((i) => Math.max(spans[i], 0.12) + 2 * room);
    const directions = [across, up].map((i) => new THREE.Vector3().setComponent(i, 1));
    const normal = new THREE.Vector3().crossVectors(...directions);
    const place = new THREE.Vector3().setComponent(axis, (at - this.middle[axis]) / this.size);
    this.plane.matrixAutoUpdate = false;
    this.plane.matrix.makeBasis(...directions, normal).scale(new THREE.Vector3(...lengths, 1)).setPosition(place);
    this.plane.matrixWorldNeedsUpdate = true;
    this.knobRadius = 0.011;
    this.knob.scale.set(this.knobRadius / lengths[0], this.knobRadius / lengths[1], this.knobRadius);
    this.knob.position.set(0.5, 0.5, 0);
    // What lies towards the viewer of the first view is cut away: below x and y, above z.
    const side = axis === 2 ? -1 : 1;
    this.clip.normal.set(0, 0, 0).setComponent(axis, side);
    this.clip.constant = -side * place.getComponent(axis);
    for (const { material, solid } of this.objects) {
      if (material) material.clippingPlanes = opened.includes(solid) ? [this.clip] : [];
    }
    this.axis = axis;
    this.render();
  }

  /** Where the knob is on the canvas [pixels], and how far there a metre along the plane's axis is. */
  knobOnCanvas() {
    const place = this.knob.getWorldPosition(new THREE.Vector3());
    const onCanvas = (point) => {
      const p = point.clone().project(this.camera);
      return [((p.x + 1) / 2) * this.canvas.clientWidth, ((1 - p.y) / 2) * this.canvas.clientHeight];
    };
    const [x, y] = onCanvas(place);
    const step = 0.01;
    const [nx, ny] = onCanvas(place.clone().setComponent(this.axis, place.getComponent(this.axis) + step));
    return { x, y, along: [(nx - x) / step / this.size, (ny - y) / step / this.size] };
  }

  /** Turns the camera to a side, "corner" or along an axis, as near as all surfaces are seen. */
  look(side) {
    const back = new THREE.Vector3(...{ corner: [-0.45, -1, 0.75], x: [1, 0, 0], y: [0, -1, 0], z: [0, -1e-3, 1] }[side]).normalize();
    const right = new THREE.Vector3().crossVectors(this.camera.up, back).normalize();
    const above = new THREE.Vector3().crossVectors(back, right);
    const tangent = Math.tan((this.camera.fov / 2) * (Math.PI / 180));
    let distance = 0.1;
    for (let corner = 0; corner < 8; corner++) {
      const point = new THREE.Vector3(...[0, 1, 2].map((i) => ((corner >> i) & 1 ? 0.5 : -0.5) * (this.high[i] - this.low[i]) / this.size));
      const need = Math.max(Math.abs(point.dot(right)) / this.camera.aspect, Math.abs(point.dot(above))) / tangent;
      distance = Math.max(distance, MARGIN_OF_VIEW * need + point.dot(back));
    }
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(back).multiplyScalar(distance);
    this.controls.update();
    this.render();
  }

  /** Brings the camera nearer to `place` [m], to see `radius` [m] around it. */
  lookCloser(place, radius) {
    const target = new THREE.Vector3(...place.map((value, i) => (value - this.middle[i]) / this.size));
    const back = this.camera.position.clone().sub(this.controls.target).normalize();
    const tangent = Math.tan((this.camera.fov / 2) * (Math.PI / 180));
    const distance = radius / this.size / tangent / Math.min(1, this.camera.aspect);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(back, Math.max(distance, 0.02));
    this.controls.update();
    this.render();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    const first = !this.isSized;
    this.isSized = true;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (first) this.look("corner");
    this.render();
  }

  /** Draws at the next frame of the screen, once however often it is asked. */
  render() {
    this.asked ??= requestAnimationFrame(() => {
      this.asked = null;
      this.lamp.position.copy(this.camera.position).add(new THREE.Vector3(-0.6, 0.4, 1.2));
      this.renderer.render(this.scene, this.camera);
    });
  }
}
