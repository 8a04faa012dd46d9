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
  NoColors,
  PCFShadowMap,
  Points,
  PointsMaterial,
  Raycaster,
  RepeatWrapping,
  Scene,
  ShaderChunk,
  Sphere,
  sRGBEncoding,
  Texture,
  Vector2,
  Vector3,
  VertexColors,
  WebGLRenderer,
} from 'three';
import { OrbitCamera } from './camera.js';
import { edgesOf, facesOf, SmoothSurface } from './smooth.js';

// light is linear, and the canvas is not
ShaderChunk.encodings_fragment = 'gl_FragColor = LinearTosRGB(gl_FragColor);';
const linear = (...sRGB) => new Color(...sRGB).convertSRGBToLinear();

// the colours of viridis (Smith, van der Walt 2015) at equal steps
export const viridis = [
  [68, 1, 84],
  [71, 45, 123],
  [59, 82, 139],
  [44, 114, 142],
  [33, 145, 140],
  [40, 174, 128],
  [94, 201, 98],
  [173, 220, 48],
  [253, 231, 37],
];
// of 256 values from 0 to 1, and last of what is no number, in linear light
const shades = new Float32Array(3 * 257);
for (let i = 0; i < 257; ++i) {
  const at = (i / 255) * 8;
  const k = Math.min(Math.floor(at), 7);
  const mixed = i < 256 ? viridis[k].map((c, j) => (c + (at - k) * (viridis[k + 1][j] - c)) / 255) : [0.6, 0.6, 0.6];
  linear(...mixed).toArray(shades, 3 * i);
}
function shade(value, colours, at) {
  const i = 3 * (value === value ? Math.round(255 * Math.min(1, Math.max(0, value))) : 256);
  colours[at] = shades[i];
  colours[at + 1] = shades[i + 1];
  colours[at + 2] = shades[i + 2];
}

const brightness = 2.2; // of the light
// three.js mirrors c (e/2 + 1) / (4 pi) of the light at the most, and pictures do c
function mirrored({ specular, shininess }) {
  const scale = (4 * Math.PI) / ((shininess / 2 + 1) * brightness);
  return new Color(...specular.map((c) => Math.min(1, c * scale)));
}

const white = new Color(1, 1, 1);
const dark = new Color(0.05, 0.05, 0.05);

const changing = (array) => {
  const attribute = new BufferAttribute(array, 3);
  attribute.usage = DynamicDrawUsage;
  return attribute;
};

export class StageView {
  orbit = new OrbitCamera();
  bodies = []; // { path, objects, surface, ... }
  drawn = 0; // frames

  textures = [];
  legend = null; // { low, high } of the values that colours show

  /** Throws where there is no WebGL 2. */
  constructor(canvas) {
    this.canvas = canvas;
    const context = canvas.getContext('webgl2', { antialias: true, alpha: true });
    if (!context) throw new Error('its canvas has no context webgl2');
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.physicallyCorrectLights = true;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.scene = new Scene();
    this.around = new HemisphereLight(0xffffff, linear(0xa8a29a), 1.5);
    this.light = new DirectionalLight(0xffffff, brightness);
    this.light.castShadow = true;
    this.light.shadow.mapSize.set(2048, 2048);
    this.light.shadow.radius = 3;
    this.light.shadow.bias = -0.006; // of the depth, 3 radii of the scene
    this.scene.add(this.around, this.light, this.light.target);
    this.sphere = new Sphere(new Vector3(), 1);
  }

  /** Images, which topologies count; `changed` is called when they can be seen. */
  setTextures(files, changed) {
    for (const texture of this.textures) texture.dispose();
    this.textures = files.map((file) => {
      const texture = new Texture();
      texture.wrapS = texture.wrapT = RepeatWrapping;
      texture.encoding = sRGBEncoding;
      texture.flipY = false; // the image is turned over when it is read
      texture.anisotropy = 4;
      createImageBitmap(file, { imageOrientation: 'flipY' }).then((image) => {
        texture.image = image;
        texture.needsUpdate = true;
        changed();
      });
      return texture;
    });
  }
  /** Other elements are seen from the next frame on. */
  setTopology(topology) {
    const before = new Map(this.bodies.map((body) => [body.path, body.visible]));
    this.clear();
    this.topology = topology;
    this.bodies = topology.bodies.map((body) => ({
      ...body,
      colour: linear(...body.colour),
      visible: before.get(body.path) ?? body.visible,
      objects: [],
    }));
  }
  /** The next frame is the first of another scene. */
  forget() {
    this.frame = null;
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
      this.#colour(body, this.#valuesOf(body));
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
    const through = body.opacity < 1 ? { transparent: true, opacity: body.opacity, depthWrite: false } : {};
    const faces = facesOf(body);
    if (faces.length) {
      const texture = this.textures[body.texture];
      body.surface = new SmoothSurface(faces, points, texture ? facesOf(body.inTexture) : null, body.beyond);
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', changing(body.surface.positions));
      geometry.setAttribute('normal', changing(body.surface.normals));
      geometry.setIndex(new BufferAttribute(body.surface.drawn, 1));
      if (texture) geometry.setAttribute('uv', new BufferAttribute(this.#placesOf(body), 2));
      body.map = texture ?? null;
      const material = new MeshPhongMaterial({
        color: body.colour,
        map: body.map,
        side: DoubleSide,
        specular: mirrored(body),
        shininess: body.shininess,
        polygonOffset: true, // edges are seen on the faces they belong to
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
        ...through,
      });
      body.mesh = new Mesh(geometry, material);
      body.mesh.castShadow = body.opacity === 1;
      body.mesh.receiveShadow = true;
      add(body.mesh);
    }
    const edges = edgesOf(body);
    if (edges.length) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', body.places);
      geometry.setIndex(new BufferAttribute(edges, 1));
      const color = faces.length ? body.colour.clone().multiplyScalar(0.25) : body.colour;
      add(new LineSegments(geometry, new LineBasicMaterial({ color, ...through })));
    }
    if (!faces.length && !edges.length) {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', body.places);
      const material = new PointsMaterial({ color: body.colour, sizeAttenuation: false, ...through });
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
  #placesOf(body) {
    const places = new Float32Array(2 * body.surface.places.length);
    body.surface.places.forEach((t, v) => {
      const none = t < 0 || t === 0xffffffff;
      if (!none) places.set(body.texcoords.subarray(2 * t, 2 * t + 2), 2 * v);
    });
    return places;
  }
  #move(body, points) {
    body.places.array.set(points);
    body.places.needsUpdate = true;
    if (!body.surface) return;
    body.surface.update(points);
    body.mesh.geometry.attributes.position.needsUpdate = true;
    body.mesh.geometry.attributes.normal.needsUpdate = true;
  }
  setLegend(legend) {
    const changed = legend?.low !== this.legend?.low || legend?.high !== this.legend?.high;
    this.legend = legend;
    if (changed && this.frame) for (const body of this.bodies) this.#colour(body, this.#valuesOf(body));
  }
  #valuesOf(body) {
    return this.frame.values?.subarray(body.first, body.first + body.points);
  }
  // by values between those of the legend, or by the colour of the body
  #colour(body, values) {
    const { low, high } = this.legend ?? { low: 0, high: 1 };
    const coloured = !!values && values.some((value) => value === value);
    if (!coloured && !body.coloured) return;
    const scale = high > low ? 1 / (high - low) : 0;
    for (const object of body.objects) {
      const source = object === body.mesh ? body.surface.source : null;
      const isEdge = !!body.mesh && object !== body.mesh;
      const { geometry, material } = object;
      if (coloured !== body.coloured) {
        if (coloured && !isEdge) {
          const count = geometry.attributes.position.count;
          geometry.setAttribute('color', changing(new Float32Array(3 * count)));
        }
        material.vertexColors = coloured && !isEdge ? VertexColors : NoColors;
        if (object === body.mesh) material.map = coloured ? null : body.map;
        material.color.copy(isEdge ? (coloured ? dark : body.colour.clone().multiplyScalar(0.25)) : coloured ? white : body.colour);
        material.needsUpdate = true;
      }
      if (!coloured || isEdge) continue;
      const { array } = geometry.attributes.color;
      for (let v = 0; 3 * v < array.length; ++v) shade((values[source ? source[v] : v] - low) * scale, array, 3 * v);
      geometry.attributes.color.needsUpdate = true;
    }
    body.coloured = coloured;
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
