// SPDX-License-Identifier: BSL-1.0
// The camera of the window (include/sinew/view/camera.hpp), over one of three.js.
import { Math as MathUtils, PerspectiveCamera, Vector3 } from 'three';

export class OrbitCamera {
  camera = new PerspectiveCamera(40, 1, 0.01, 100);
  target = new Vector3();
  toEye = new Vector3(0, 0, 1); // from the target, of length 1
  up = new Vector3(0, 1, 0);
  distance = 1;

  right() {
    return new Vector3().crossVectors(this.up, this.toEye).normalize();
  }
  above() {
    return new Vector3().crossVectors(this.toEye, this.right());
  }
  /** All of a sphere, from the right above its front. */
  home(centre, radius, up) {
    this.up.fromArray(up).normalize();
    const aside = Math.abs(this.up.z) > 0.7 ? new Vector3(0, -1, 0) : new Vector3(0, 0, 1);
    const right = new Vector3().crossVectors(this.up, aside).normalize();
    const front = new Vector3().crossVectors(right, this.up);
    this.toEye = front.addScaledVector(right, 0.6).addScaledVector(this.up, 0.5).normalize();
    this.fit(centre, radius);
  }
  fit(centre, radius) {
    const half = MathUtils.degToRad(this.camera.fov / 2);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    this.target.copy(centre);
    this.distance = radius / Math.sin(narrow);
    this.radius = radius;
  }
  /** Along an axis; the second time from its other side. */
  along(axis) {
    const direction = new Vector3().setComponent(axis, 1);
    if (direction.dot(this.toEye) > 0.999) direction.negate();
    // at the pole, right() has no direction
    const pole = direction.dot(this.up);
    if (Math.abs(pole) > 0.99) {
      const level = this.toEye.clone().addScaledVector(this.up, -this.toEye.dot(this.up)).normalize();
      const most = MathUtils.degToRad(89);
      direction.multiplyScalar(Math.sin(most)).addScaledVector(level, Math.cos(most));
    }
    this.toEye.copy(direction).normalize();
  }
  /** Turns round the target: about what is upwards, and towards it [rad]. */
  orbit(about, towards) {
    this.toEye.applyAxisAngle(this.up, about);
    const height = Math.asin(MathUtils.clamp(this.toEye.dot(this.up), -1, 1));
    const limit = MathUtils.degToRad(89);
    const turn = MathUtils.clamp(height + towards, -limit, limit) - height;
    this.toEye.applyAxisAngle(this.right(), -turn).normalize();
  }
  /** By pixels, so that what is at the distance of the target stays below the pointer. */
  shift(dx, dy, height) {
    const scale = (2 * this.distance * Math.tan(MathUtils.degToRad(this.camera.fov / 2))) / height;
    this.target.addScaledVector(this.right(), -dx * scale).addScaledVector(this.above(), dy * scale);
  }
  zoom(clicks) {
    this.distance *= 0.9 ** clicks;
  }
  update(aspect) {
    const c = this.camera;
    const size = this.radius || 1;
    c.aspect = aspect;
    c.near = Math.max(this.distance - 4 * size, this.distance / 200);
    c.far = this.distance + 12 * size;
    c.position.copy(this.target).addScaledVector(this.toEye, this.distance);
    c.up.copy(this.up);
    c.lookAt(this.target);
    c.updateProjectionMatrix();
    c.updateMatrixWorld();
  }
}
