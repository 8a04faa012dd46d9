// SPDX-License-Identifier: BSL-1.0
// The fields of the selected component, changed while the scene runs.

export class Fields {
  constructor(element, change) {
    this.element = element;
    this.change = change; // (line, field, value)
    this.component = null;
  }

  show(component) {
    const same =
      this.component?.line === component.line && this.component.fields.length === component.fields.length;
    this.component = component;
    if (!same) this.#make();
    component.fields.forEach((field, i) => this.#fill(field, this.inputs[i]));
  }
  clear() {
    this.component = null;
    this.element.replaceChildren();
  }
  #make() {
    this.inputs = [];
    this.element.replaceChildren(
      ...this.component.fields.map((field) => {
        const label = document.createElement('label');
        const name = document.createElement('span');
        const unit = document.createElement('span');
        name.textContent = field.name;
        unit.textContent = field.unit;
        label.title = [field.help, field.kind, field.range, field.default && `default: ${field.default}`, field.fixed]
          .filter(Boolean)
          .join('\n');
        let input;
        if (field.choices.length) {
          input = document.createElement('select');
          const words = field.kind === 'yes or no' ? { 0: 'no', 1: 'yes' } : {};
          for (const choice of field.choices) input.add(new Option(words[choice] ?? choice, choice));
        } else {
          input = document.createElement('input');
          input.type = 'text';
          input.spellcheck = false;
          input.addEventListener('keydown', (event) => {
            if (event.key === 'Escape') {
              input.value = input.dataset.value;
              input.blur();
            }
          });
        }
        input.addEventListener('change', () => {
          if (input.value !== input.dataset.value) this.change(this.component.line, field.name, input.value);
          input.dataset.value = ''; // what it is now comes back
        });
        this.inputs.push(input);
        label.append(name, unit, input);
        return label;
      }),
    );
  }
  #fill(field, input) {
    input.disabled = !!field.fixed || !field.whole;
    const value = field.whole ? field.value : `${field.entries} entries`;
    // what is being typed stays
    if (input === document.activeElement && input.type === 'text' && input.value !== input.dataset.value) return;
    if (input.dataset.value === value) return;
    input.dataset.value = value;
    input.value = value;
  }
}
