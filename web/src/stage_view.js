// SPDX-License-Identifier: BSL-1.0
// Draws what is seen of a scene, by three.js.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  DynamicDrawUsage,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshPhongMaterial,
  PCFShadowMap,
  Points,
  PointsMaterial,
  Raycaster,
  Scene,
  Sphere,
  SRGBColorSpace,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitCamera } from './camera.js';
import { edgesOf, facesOf, SmoothSurface } from './smooth.js';

// colours that people who see colours differently can tell apart (Okabe, Ito 2008)
export const palette = [
  [0.84, 0.37, 0.0],
  [0.0, 0.45, 0.7],
  [0.0, 0.62, 0.45],
  [0.8, 0.47, 0.65],
  [0.9, 0.62, 0.0],
  [0.34, 0.71, 0.91],
  [0.94, 0.89, 0.26],
];
export const colourOf = (body) => new Color().setRGB(...palette[body % palette.length], SRGBColorSpace);

const changing = (array) => {
  const attribute = new BufferAttribute(array, 3);
  attribute.usage = DynamicDrawUsage;
  return attribute;
};

export class StageView {
  orbit = new OrbitCamera();
  bodies = []; // { path, objects, surface, ... }
  drawn = 0; // frames

  /** Throws where there is no WebGL 2. */
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene = new Scene();
    this.around = new HemisphereLight(0xffffff, 0xa8a29a, 1.5);
    this.light = new DirectionalLight(0xffffff, 2.2);
    this.light.castShadow = true;
    this.light.shadow.mapSize.set(2048, 2048);
    this.light.shadow.radius = 3;
    this.scene.add(this.around, this.light, this.light.target);
    this.sphere = new Sphere(new Vector3(), 1);
  }

  /** Other elements are seen from the next frame on. */
  setTopology(topology) {
    const hidden = new Set(this.bodies.filter((body) => !body.visible).map((body) => body.path));
    this.clear();
    this.topology = topology;
    this.bodies = topology.bodies.map((body, number) => ({
      ...body,
      colour: colourOf(number),
      visible: !hidden.has(body.path),
      objects: [],
    }));
  }
  clear() {
    for (const body of this.bodies)
      for (const object of body.objects) {
        this.scene.remove(object);
        object.geometry.dispose();
        object.material.dispose();
      }
  }

  show(frame) {
    const isFirst = !this.frame;
    this.frame = frame;
    for (const body of this.bodies) {
      const points = frame.positions.subarray(3 * body.first, 3 * (body.first + body.points));
      if (body.places) this.#move(body, points);
      else this.#make(body, points);
    }
    this.#measure();
    if (isFirst) this.home();
  }
  #make(body, points) {
    body.places = changing(points.slice());
    const add = (object) => {
      object.frustumCulled = false; // its points move
      object.visible = body.visible;
      body.objects.push(object);
      this.scene.add(object);
    };
    const faces = facesOf(body);
    if (faces.length) {
      body.surface = new SmoothSurface(faces, points);
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', changing(body.surface.positions));
      geometry.setAttribute('normal', changing(body.surface.normals));
      geometry.setIndex(new BufferAttribute(body.surface.index, 1));
      const material = new MeshPhongMaterial({
        color: body.colour,
        side: DoubleSide,
        specular: 0x333333,
        shininess: 40,
        polygonOffset: true, // edges are seen on the faces they belong to
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      });
      body.mesh = new Mesh(geometry, material);
      body.mesh.castShadow = body.mesh.receiveShadow = true;
      add(body.mesh);
    }
    const edges = edgesOf(body);
    if (edges.length) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', body.places);
      geometry.setIndex(new BufferAttribute(edges, 1));
      const color = faces.length ? body.colour.clone().multiplyScalar(0.25) : body.colour;
      add(new LineSegments(geometry, new LineBasicMaterial({ color })));
    }
    if (!faces.length && !edges.length) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', body.places);
      const material = new PointsMaterial({ color: body.colour, sizeAttenuation: false });
      material.onBeforeCompile = (shader) => {
        shader.fragmentShader = shader.fragmentShader.replace(
          '#include <clipping_planes_fragment>',
          'if (length(gl_PointCoord - 0.5) > 0.5) discard;\n#include <clipping_planes_fragment>',
        );
      };
      body.dots = new Points(geometry, material);
      add(body.dots);
    }
  }
  #move(body, points) {
    body.places.array.set(points);
    body.places.needsUpdate = true;
    if (!body.surface) return;
    body.surface.update(points);
    body.mesh.geometry.attributes.position.needsUpdate = true;
    body.mesh.geometry.attributes.normal.needsUpdate = true;
  }
  // a sphere around all that is finite
  #measure() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const p = this.frame.positions;
    for (let i = 0; i < p.length; i += 3) {
      if (!Number.isFinite(p[i] + p[i + 1] + p[i + 2])) continue;
      for (let k = 0; k < 3; ++k) {
        if (p[i + k] < low[k]) low[k] = p[i + k];
        if (p[i + k] > high[k]) high[k] = p[i + k];
      }
    }
    if (!(low[0] <= high[0])) low.fill(0), high.fill(0);
    this.sphere.center.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2);
    this.sphere.radius = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2 || 1;
  }

  home() {
    if (this.frame) this.orbit.home(this.sphere.center, this.sphere.radius, this.topology.up);
  }
  setVisible(path, visible) {
    for (const body of this.bodies)
      if (body.path === path) {
        body.visible = visible;
        for (const object of body.objects) object.visible = visible;
      }
  }

  resize(width, height, ratio) {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.width = width;
    this.height = height;
    for (const body of this.bodies) if (body.dots) body.dots.material.size = this.#dotSize();
  }
  #dotSize() {
    return Math.max(5, this.height / 90) * this.renderer.getPixelRatio();
  }

  draw() {
    if (!this.width || !this.height) return;
    this.orbit.update(this.width / this.height);
    const { center, radius } = this.sphere;
    // from the left above the eye, with its shadow on the sphere around everything
    const from = this.orbit.toEye
      .clone()
      .multiplyScalar(0.6)
      .addScaledVector(this.orbit.right(), -0.5)
      .addScaledVector(this.orbit.above(), 0.7)
      .normalize();
    this.light.position.copy(center).addScaledVector(from, 2 * radius);
    this.light.target.position.copy(center);
    const shade = this.light.shadow.camera;
    shade.left = shade.bottom = -1.05 * radius;
    shade.right = shade.top = 1.05 * radius;
    shade.near = 0.5 * radius;
    shade.far = 3.5 * radius;
    shade.updateProjectionMatrix();
    this.light.shadow.normalBias = 0.02 * radius;
    this.around.position.copy(this.orbit.up);
    for (const body of this.bodies) if (body.dots) body.dots.material.size = this.#dotSize();
    this.renderer.render(this.scene, this.orbit.camera);
    ++this.drawn;
  }

  /** Origin and direction of the ray that is seen at a place of the canvas. */
  ray(x, y) {
    this.orbit.update(this.width / this.height);
    const at = new Vector2((2 * x) / this.width - 1, 1 - (2 * y) / this.height);
    const caster = new Raycaster();
    caster.setFromCamera(at, this.orbit.camera);
    return caster;
  }
  /** Whether a face is seen there. */
  meets(x, y) {
    const caster = this.ray(x, y);
    const seen = this.bodies.filter((body) => body.mesh && body.visible);
    // the box of a mesh that moves is out of date
    for (const body of seen) body.mesh.geometry.boundingSphere = new Sphere(this.sphere.center, 2 * this.sphere.radius);
    return caster.intersectObjects(seen.map((body) => body.mesh), false).length > 0;
  }
  /** The place of the canvas at which a point is seen. */
  project(point) {
    const at = new Vector3().fromArray(point).project(this.orbit.camera);
    return [((at.x + 1) / 2) * this.width, ((1 - at.y) / 2) * this.height];
  }
}
