// SPDX-License-Identifier: BSL-1.0
// Where the time of a step goes: a bar for each component, and tables and pictures of that.

const number = (value) => Number(value.toPrecision(3));
const timeOf = (milliseconds) => (milliseconds < 0.1 ? `${number(1000 * milliseconds)} µs` : `${number(milliseconds)} ms`);

export const csvOf = ({ shares }) =>
  ['component or phase,class,time in a step [ms],share [%]']
    .concat(shares.map((s) => `${s.name.replace(/[,"\r\n]/g, ' ')},${s.class.replace(/[,"\r\n]/g, ' ')},${s.milliseconds},${100 * s.share}`))
    .join('\n') + '\n';

export function svgOf({ steps, shares }) {
  const safe = (words) => words.replace(/[&<>]/g, (c) => `&#${c.charCodeAt(0)};`);
  const most = Math.max(...shares.map((s) => s.milliseconds), 1e-12);
  const rows = shares.map((s, i) => {
    const y = 22 * (i + 1);
    const bar = (330 * s.milliseconds) / most;
    return `<text x="292" y="${y + 15}" text-anchor="end">${safe(s.name)}</text><rect x="300" y="${y + 3}" width="${bar}" height="16" fill="#0072b2"/><text x="${306 + bar}" y="${y + 15}">${number(s.milliseconds)} ms</text>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" width="720" height="${22 * (shares.length + 1)}" font-family="sans-serif" font-size="12"><text x="300" y="15">time in a step, mean of ${steps} steps</text>\n${rows.join('\n')}\n</svg>\n`;
}

export function save(name, type, words) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([words], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

export class ProfileList {
  profile = null;

  constructor(list, note) {
    this.list = list;
    this.note = note;
  }
  show(profile, profiling) {
    this.profile = profile;
    this.note.textContent = profile ? `in a step, mean of ${profile.steps} steps` : profiling ? 'let the scene run' : '';
    const shares = profile?.shares ?? [];
    while (this.list.children.length > shares.length) this.list.lastChild.remove();
    while (this.list.children.length < shares.length) {
      const item = document.createElement('li');
      item.append(document.createElement('meter'), document.createElement('span'), document.createElement('b'));
      this.list.append(item);
    }
    const most = shares[0]?.milliseconds || 1;
    shares.forEach((share, i) => {
      const item = this.list.children[i];
      const [bar, name, time] = item.children;
      bar.value = share.milliseconds / most;
      name.textContent = share.name;
      time.textContent = timeOf(share.milliseconds);
      item.title = `${share.class || 'a phase, outside of components'}: ${(100 * share.share).toFixed(1)} % of the step`;
    });
  }
}
