// SPDX-License-Identifier: BSL-1.0
// What is measured after each step, over time: plots, a table and a picture of them. The stage keeps no more than its
// last steps, and says each of them once to who asks.

const most = 20000; // steps; of more, the older half goes
const every = 200; // asks for more [ms]
const digits = (value) => (Number.isFinite(value) ? Number(value.toPrecision(4)) : '–');
const titleOf = ({ name, unit }) => (unit ? `${name} [${unit}]` : name);

export function csvOfMeasures({ times, series }) {
  const cell = (words) => words.replace(/[,"\r\n]/g, ' ');
  return ['time [s]', ...series.map((s) => cell(titleOf(s)))]
    .join(',')
    .concat('\n', ...times.map((t, i) => `${[t, ...series.map((s) => s.values[i] ?? '')].join(',')}\n`));
}

/** The ends of what is finite, and at which height of `high` each value is drawn: the path of a plot. */
function lineOf(times, values, left, top, wide, high) {
  let least = Infinity, greatest = -Infinity;
  for (const v of values) if (Number.isFinite(v)) (least = Math.min(least, v)), (greatest = Math.max(greatest, v));
  if (!(least <= greatest)) least = greatest = 0;
  const range = greatest > least ? greatest - least : 1;
  const first = times[0] ?? 0;
  const span = times.at(-1) > first ? times.at(-1) - first : 1;
  // a pixel shows no more than two values
  const stride = Math.max(1, Math.floor(times.length / (2 * wide)));
  const points = [];
  for (let i = 0; i < values.length; i += stride)
    if (Number.isFinite(values[i]))
      points.push(`${(left + (wide * (times[i] - first)) / span).toFixed(1)},${(top + high * (1 - (values[i] - least) / range)).toFixed(1)}`);
  return { points: points.join(' '), least, greatest: least + range };
}

export function svgOfMeasures({ times, series }) {
  const safe = (words) => words.replace(/[&<>]/g, (c) => `&#${c.charCodeAt(0)};`);
  const [wide, high, left, top] = [620, 100, 80, 26];
  const rows = series.map((s, k) => {
    const y = 150 * k + top;
    const { points, least, greatest } = lineOf(times, s.values, left, y, wide, high);
    const say = (x, at, anchor, words) => `<text x="${x}" y="${at}" text-anchor="${anchor}">${safe(String(words))}</text>`;
    return [
      `<rect x="${left}" y="${y}" width="${wide}" height="${high}" fill="none" stroke="#999"/>`,
      say(left, y - 8, 'start', titleOf(s)),
      say(left - 6, y + 10, 'end', digits(greatest)),
      say(left - 6, y + high, 'end', digits(least)),
      say(left, y + high + 16, 'start', `${digits(times[0] ?? 0)} s`),
      say(left + wide, y + high + 16, 'end', `${digits(times.at(-1) ?? 0)} s`),
      `<polyline fill="none" stroke="#0072b2" points="${points}"/>`,
    ].join('\n');
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" width="720" height="${150 * series.length}" font-family="sans-serif" font-size="12">\n${rows.join('\n')}\n</svg>\n`;
}

const nothing = () => ({ times: [], series: [] });

export class Plots {
  measures = nothing();
  #on = false;
  #asked = 0;
  #waits = false;

  constructor(list, note, send) {
    this.list = list;
    this.note = note;
    this.send = send;
  }
  open(on) {
    if (on === this.#on) return;
    this.#on = on;
    this.send({ do: 'measure', on });
    this.#show();
  }
  clear() {
    this.measures = nothing();
    this.#waits = false;
    this.#show();
  }
  /** Called again and again; asks for what is new. */
  ask(now, state) {
    const last = this.measures.times.at(-1) ?? -1e300;
    if (state.time < last) return this.clear(); // behind a reset, time begins anew
    if (!this.#on || this.#waits || now - this.#asked < every) return;
    this.#asked = now;
    this.#waits = true;
    this.send({ do: 'measures', after: last });
  }
  add({ times, series }) {
    this.#waits = false;
    const known = this.measures;
    if (known.series.map(titleOf).join('\n') !== series.map(titleOf).join('\n')) {
      this.measures = { times: [], series: series.map(({ name, unit }) => ({ name, unit, values: [] })) };
      // those that were measured before the new ones are asked for again
      if (known.times.length) return this.#show();
    }
    const take = (list, more) => {
      for (const value of more) list.push(value ?? NaN);
      if (list.length > most) list.splice(0, list.length - most / 2);
    };
    take(this.measures.times, times);
    series.forEach((s, k) => take(this.measures.series[k].values, s.values));
    this.#show();
  }
  #show() {
    const { times, series } = this.measures;
    this.note.textContent = times.length ? `${times.length} steps, to ${digits(times.at(-1))} s` : this.#on ? 'let the scene run' : '';
    while (this.list.children.length > series.length) this.list.lastChild.remove();
    while (this.list.children.length < series.length) {
      const item = document.createElement('li');
      item.innerHTML =
        '<span></span><b></b><svg viewBox="0 0 280 56" preserveAspectRatio="none"><polyline vector-effect="non-scaling-stroke"/></svg><small></small>';
      this.list.append(item);
    }
    series.forEach((s, k) => {
      const [title, value, plot, ends] = this.list.children[k].children;
      const { points, least, greatest } = lineOf(times, s.values, 0, 2, 280, 52);
      title.textContent = titleOf(s);
      title.title = title.textContent;
      value.textContent = digits(s.values.at(-1));
      plot.firstChild.setAttribute('points', points);
      ends.textContent = `${digits(least)} to ${digits(greatest)}`;
    });
  }
}
