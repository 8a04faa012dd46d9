// SPDX-License-Identifier: BSL-1.0
// What the pointer does: the left button pulls what it is pressed on, and beside bodies turns the camera; the right one
// shifts it; the wheel goes nearer; two fingers shift and go nearer.

export class Pointer {
  stiffness = 100; // of the spring that pulls [N/m]

  constructor(view, send, changed) {
    this.view = view;
    this.send = send;
    this.changed = changed;
    this.down = new Map(); // pointers, by their numbers
    this.doing = null;
    const canvas = view.canvas;
    canvas.addEventListener('pointerdown', (event) => this.#press(event));
    canvas.addEventListener('pointermove', (event) => this.#move(event));
    // wherever that is; a canvas that has lost its capture for a moment still has what it holds
    for (const end of ['pointerup', 'pointercancel']) addEventListener(end, (event) => this.#release(event));
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        view.orbit.zoom(-event.deltaY / (event.deltaMode === 0 ? 100 : 3));
        changed();
      },
      { passive: false },
    );
  }

  #place(event) {
    const box = this.view.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }
  #ray(place) {
    const { origin, direction } = this.view.ray(...place).ray;
    return { origin: origin.toArray(), direction: direction.toArray() };
  }
  #press(event) {
    const place = this.#place(event);
    this.view.canvas.setPointerCapture(event.pointerId);
    this.down.set(event.pointerId, place);
    this.#let();
    if (this.down.size > 1) this.doing = 'pinches';
    else if (event.button !== 0) this.doing = 'shifts';
    else if (!this.view.meets(...place)) this.doing = 'turns';
    else {
      this.doing = 'pulls';
      this.send({ do: 'press', ...this.#ray(place), stiffness: this.stiffness });
    }
  }
  #move(event) {
    const before = this.down.get(event.pointerId);
    if (!before) {
      // what a press would do is shown by the pointer
      if (event.pointerType === 'mouse') this.hover = this.#place(event);
      return;
    }
    const place = this.#place(event);
    const dx = place[0] - before[0], dy = place[1] - before[1];
    const { orbit, height } = this.view;
    if (this.doing === 'turns') {
      orbit.orbit((-dx / height) * Math.PI, (dy / height) * Math.PI);
    } else if (this.doing === 'shifts') {
      orbit.shift(dx, dy, height);
    } else if (this.doing === 'pulls') {
      this.pulled = place; // said once a frame
    } else if (this.doing === 'pinches') {
      const other = [...this.down].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const span = (at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
        orbit.shift(dx / 2, dy / 2, height);
        orbit.distance *= span(before) / span(place);
      }
    }
    this.down.set(event.pointerId, place);
    this.changed();
  }
  #release(event) {
    if (!this.down.delete(event.pointerId)) return;
    this.#let();
    this.doing = null;
  }
  #let() {
    if (this.doing === 'pulls') this.send({ do: 'release' });
    this.pulled = null;
  }

  /** Called once a frame. */
  frame() {
    if (this.pulled) {
      this.send({ do: 'move', ...this.#ray(this.pulled) });
      this.pulled = null;
    }
    if (this.hover && this.view.frame) {
      this.view.canvas.style.cursor = this.view.meets(...this.hover) ? 'grab' : '';
      this.hover = null;
    }
    if (this.doing === 'pulls') this.view.canvas.style.cursor = 'grabbing';
  }
}
