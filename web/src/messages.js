// SPDX-License-Identifier: BSL-1.0
// The binary messages of a stage (include/sinew/view/protocol.hpp): words of four bytes, the lowest first.

export const kindOf = (buffer) => new Uint32Array(buffer, 0, 1)[0];
export const topologyKind = 1;
export const frameKind = 2;
export const texturesKind = 3;

/** The elements of what is seen. */
export function readTopology(buffer) {
  const words = new Uint32Array(buffer);
  const text = new TextDecoder();
  const up = new Float32Array(buffer, 8, 3);
  const bodies = [];
  let at = 6;
  let first = 0;
  for (let b = 0; b < words[5]; ++b) {
    const kind = words[at];
    const colour = [...new Float32Array(buffer, 4 * (at + 1), 3)];
    const [opacity] = new Float32Array(buffer, 4 * (at + 4), 1);
    const [pathBytes, points, triangles, quads, edges, beyond, texture, texcoords] = words.subarray(at + 5, at + 13);
    const [...specular] = new Float32Array(buffer, 4 * (at + 13), 3);
    const [shininess] = new Float32Array(buffer, 4 * (at + 16), 1);
    at += 17;
    const path = text.decode(new Uint8Array(buffer, 4 * at, pathBytes));
    at += Math.ceil(pathBytes / 4);
    const take = (count) => words.subarray(at, (at += count));
    const body = {
      path,
      visual: kind % 4 === 1,
      visible: kind < 4,
      colour,
      opacity,
      first, // of its points among those of all bodies
      points,
      triangles: take(3 * triangles),
      quads: take(4 * quads),
      edges: take(2 * edges),
      beyond: take(3 * beyond), // faces of other parts that meet those of this one
      texture: texture - 1, // -1: none
      specular,
      shininess,
    };
    if (texture) {
      body.texcoords = new Float32Array(buffer, 4 * at, 2 * texcoords);
      at += 2 * texcoords;
      // their numbers at the corners of the elements
      body.inTexture = { triangles: take(3 * triangles), quads: take(4 * quads) };
    }
    bodies.push(body);
    first += points;
  }
  return { number: words[1], up: [...up], bodies, points: first };
}

/** The files of the textures, PNG or JPEG. */
export function readTextures(buffer) {
  const words = new Uint32Array(buffer);
  const files = [];
  let at = 2;
  for (let k = 0; k < words[1]; ++k) {
    files.push(new Blob([new Uint8Array(buffer, 4 * (at + 1), words[at])]));
    at += 1 + Math.ceil(words[at] / 4);
  }
  return files;
}

/** A moment: x, y, z of all points of all bodies, and perhaps the values that colours show. */
export function readFrame(buffer) {
  const words = new Uint32Array(buffer, 0, 4);
  const [time, step] = new Float64Array(buffer, 16, 2);
  const positions = new Float32Array(buffer, 32, 3 * words[2]);
  const values = words[3] ? new Float32Array(buffer, 32 + positions.byteLength, words[3]) : null;
  return { topology: words[1], time, step, positions, values };
}
