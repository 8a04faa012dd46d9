// SPDX-License-Identifier: BSL-1.0
// The tree of the scene: nodes fold, components are selected, a search leaves what matches and what is above it.

export class Tree {
  constructor(list, search, { select, setVisible }) {
    this.list = list;
    this.search = search;
    this.select = select;
    this.setVisible = setVisible;
    this.lines = [];
    this.folded = new Set();
    this.selected = -1;
    search.addEventListener('input', () => this.#sift());
    search.addEventListener('keydown', (event) => {
      if (event.key !== 'Escape') return;
      search.value = '';
      search.blur();
      this.#sift();
    });
  }

  set(lines) {
    const above = [];
    this.lines = lines.map((line, number) => {
      above.length = line.depth;
      const isNode = !line.class;
      if (isNode) above.push(line.name);
      return { ...line, number, isNode, path: '/' + above.join('/'), item: document.createElement('li') };
    });
    this.list.replaceChildren(...this.lines.map((line) => this.#fill(line)));
    this.#sift();
  }
  #fill(line) {
    const { item } = line;
    item.role = 'treeitem';
    item.className = line.isNode ? 'node' : 'component';
    item.style.setProperty('--depth', line.depth);
    item.ariaLevel = line.depth + 1;
    if (line.isNode) {
      line.fold = document.createElement('button');
      line.fold.className = 'fold';
      line.fold.addEventListener('click', () => {
        if (!this.folded.delete(line.number)) this.folded.add(line.number);
        this.#sift();
      });
      item.append(line.fold, line.name || '(no name)');
    } else {
      const [plain, template] = line.class.split(/(?=<)/);
      const small = document.createElement('small');
      small.textContent = [line.name !== plain && line.name, template].filter(Boolean).join(' ');
      item.append(plain);
      item.append(small);
      item.tabIndex = 0;
      item.title = line.class;
      const chosen = () => this.choose(line.number === this.selected ? -1 : line.number);
      item.addEventListener('click', chosen);
      item.addEventListener('keydown', (event) => event.key === 'Enter' && chosen());
    }
    return item;
  }
  choose(number) {
    this.selected = number;
    for (const line of this.lines) line.item.classList.toggle('selected', line.number === number);
    this.select(number);
  }
  #sift() {
    const words = this.search.value.trim().toLowerCase();
    let kept = new Set();
    if (words)
      this.lines.forEach((line, i) => {
        if (!`${line.name} ${line.class ?? ''}`.toLowerCase().includes(words)) return;
        kept.add(i);
        for (let depth = line.depth, above = i; above >= 0; --above)
          if (this.lines[above].depth < depth) {
            kept.add(above);
            depth = this.lines[above].depth;
          }
      });
    let hiddenBelow = Infinity;
    this.lines.forEach((line, i) => {
      if (line.depth <= hiddenBelow) hiddenBelow = Infinity;
      line.item.hidden = words ? !kept.has(i) : hiddenBelow < Infinity;
      if (line.fold) {
        const folded = !words && this.folded.has(line.number);
        line.fold.textContent = folded ? '▸' : '▾';
        line.fold.ariaLabel = folded ? 'unfold' : 'fold';
        if (folded && hiddenBelow === Infinity) hiddenBelow = line.depth;
      }
    });
  }

  /** Bodies that are seen have their colour, which switches them. */
  setBodies(bodies) {
    for (const line of this.lines) {
      line.item.querySelector('.swatch')?.remove();
      const body = line.isNode && bodies.find((b) => b.path === line.path);
      if (!body) continue;
      const swatch = document.createElement('button');
      swatch.className = 'swatch';
      swatch.style.setProperty('--colour', body.colour.clone().convertLinearToSRGB().getStyle());
      swatch.title = 'Show or hide it';
      swatch.ariaLabel = `show ${line.path}`;
      swatch.ariaPressed = String(body.visible);
      swatch.addEventListener('click', () => {
        const visible = swatch.ariaPressed !== 'true';
        swatch.ariaPressed = String(visible);
        this.setVisible(body.path, visible);
      });
      line.item.append(swatch);
    }
  }
}
