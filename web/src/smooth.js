// SPDX-License-Identifier: BSL-1.0
// Surfaces for drawing: a point becomes one corner for each group of faces around it that meet at less than 40 degrees, so
// that round surfaces look round and edges stay sharp.

const sharpest = Math.cos((40 * Math.PI) / 180);

/** Triangles of a body, or what belongs to their corners; a quad is two of them. */
export function facesOf(body) {
  const faces = new Uint32Array(body.triangles.length + (body.quads.length / 4) * 6);
  faces.set(body.triangles);
  let at = body.triangles.length;
  for (let q = 0; q < body.quads.length; q += 4) {
    const [a, b, c, d] = body.quads.subarray(q, q + 4);
    faces.set([a, b, c, a, c, d], at);
    at += 6;
  }
  return faces;
}

/** The edges of the elements of a body that is no visual model, each once; or its own. */
export function edgesOf(body) {
  const seen = new Set();
  const edges = [];
  const add = (i, j) => {
    const key = i < j ? i * body.points + j : j * body.points + i;
    if (seen.has(key)) return;
    seen.add(key);
    edges.push(i, j);
  };
  for (let e = 0; e < body.edges.length; e += 2) add(body.edges[e], body.edges[e + 1]);
  if (!body.visual)
    for (const [list, size] of [
      [body.triangles, 3],
      [body.quads, 4],
    ])
      for (let f = 0; f < list.length; f += size)
        for (let k = 0; k < size; ++k) add(list[f + k], list[f + ((k + 1) % size)]);
  return new Uint32Array(edges);
}

export class SmoothSurface {
  /**
   * `faces`: numbers of points, three each; `points`: x, y, z of each when it is first seen; `places`: numbers of what
   * each corner has of its own, of which there may be several at a point, or none; `beyond`: faces that are not drawn, which lie
   * where the surface goes on.
   */
  constructor(own, points, places = null, beyond = []) {
    const faces = new Uint32Array(own.length + beyond.length);
    faces.set(own);
    faces.set(beyond, own.length);
    const count = faces.length / 3;
    const normals = new Float32Array(faces.length); // of faces, of length 1
    for (let f = 0; f < count; ++f) {
      const n = areaOf(points, faces[3 * f], faces[3 * f + 1], faces[3 * f + 2]);
      const length = Math.hypot(...n) || 1;
      normals.set([n[0] / length, n[1] / length, n[2] / length], 3 * f);
    }
    // the corners of faces around each point
    const starts = new Uint32Array(points.length / 3 + 1);
    for (const i of faces) ++starts[i + 1];
    for (let i = 1; i < starts.length; ++i) starts[i] += starts[i - 1];
    const corners = new Uint32Array(faces.length);
    const filled = starts.slice();
    faces.forEach((i, corner) => (corners[filled[i]++] = corner));

    this.index = new Uint32Array(faces.length);
    this.drawn = this.index.subarray(0, own.length);
    const source = [];
    for (let i = 0; i + 1 < starts.length; ++i) {
      const around = corners.subarray(starts[i], starts[i + 1]);
      const group = new Int32Array(around.length).fill(-1);
      for (let a = 0; a < around.length; ++a) {
        if (group[a] >= 0) continue;
        group[a] = source.length;
        source.push(i);
        const reached = [a];
        while (reached.length) {
          const f = 3 * Math.floor(around[reached.pop()] / 3);
          for (let b = 0; b < around.length; ++b) {
            if (group[b] >= 0) continue;
            const g = 3 * Math.floor(around[b] / 3);
            const cosine = normals[f] * normals[g] + normals[f + 1] * normals[g + 1] + normals[f + 2] * normals[g + 2];
            if (cosine < sharpest) continue;
            group[b] = group[a];
            reached.push(b);
          }
        }
      }
      around.forEach((corner, a) => (this.index[corner] = group[a]));
    }
    if (places) this.#split(places, source);
    this.source = new Uint32Array(source);
    this.positions = new Float32Array(3 * source.length);
    this.normals = new Float32Array(3 * source.length);
    this.update(points);
  }

  // corners of one group at several places become several, with one normal
  #split(places, source) {
    const groups = source.map((_, v) => v);
    const known = new Map();
    this.places = source.map(() => -1);
    const taken = new Set();
    this.drawn.forEach((group, corner) => {
      const key = `${group} ${places[corner]}`;
      let v = known.get(key);
      if (v === undefined) {
        v = taken.has(group) ? source.length : group;
        taken.add(group);
        source[v] = source[group];
        groups[v] = group;
        this.places[v] = places[corner];
        known.set(key, v);
      }
      this.drawn[corner] = v;
    });
    this.groups = groups;
  }

  /** Corners and their normals, by the areas of the faces, where the points are now. */
  update(points) {
    const { index, source, positions, normals, groups } = this;
    for (let v = 0; v < source.length; ++v) {
      const p = 3 * source[v];
      positions[3 * v] = points[p];
      positions[3 * v + 1] = points[p + 1];
      positions[3 * v + 2] = points[p + 2];
    }
    normals.fill(0);
    for (let c = 0; c < index.length; c += 3) {
      const n = areaOf(positions, index[c], index[c + 1], index[c + 2]);
      for (let k = 0; k < 3; ++k) {
        const v = 3 * (groups ? groups[index[c + k]] : index[c + k]);
        normals[v] += n[0];
        normals[v + 1] += n[1];
        normals[v + 2] += n[2];
      }
    }
    for (let v = 0; v < normals.length; v += 3) {
      const length = Math.sqrt(normals[v] ** 2 + normals[v + 1] ** 2 + normals[v + 2] ** 2) || 1;
      normals[v] /= length;
      normals[v + 1] /= length;
      normals[v + 2] /= length;
    }
    groups?.forEach((group, v) => group !== v && normals.copyWithin(3 * v, 3 * group, 3 * group + 3));
  }
}

const area = [0, 0, 0];
// twice the area of a triangle, along its normal
function areaOf(p, a, b, c) {
  a *= 3;
  b *= 3;
  c *= 3;
  const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
  const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
  area[0] = uy * vz - uz * vy;
  area[1] = uz * vx - ux * vz;
  area[2] = ux * vy - uy * vx;
  return area;
}
