// The controls and texts of the window as elements inside the canvas. A browser does not draw the
// elements of a canvas, but screen readers read them and press them.
'use strict';

const kAria = {part: 'group', dialog: 'dialog', button: 'button', checkbox: 'checkbox', slider: 'slider',
  field: 'textbox', choice: 'combobox', header: 'button'};

class WindowControls {
  /// `press(id)`: the user has pressed a control. `tell(text)`: a dialog has opened.
  constructor(canvas, press, tell) {
    this.canvas = canvas;
    this.press = press;
    this.tell = tell;
    this.elements = new Map();  // by key
    this.dialog = null;         // the key of the open one
  }

  /// {focus, items}, see app/web/window_reader.hpp.
  show({focus, items}) {
    const kept = new Map(), parts = [], children = new Map([[this.canvas, parts]]);
    let part = this.canvas, dialog = null;
    for (const item of items) {
      const element = this.element(item, kept);
      if (item.role === 'part' || item.role === 'dialog') {
        part = element;
        parts.push(part);
        children.set(part, []);
        if (item.role === 'dialog') dialog = element;
      } else {
        children.get(part).push(element);
      }
    }
    for (const [parent, wanted] of children)
      if (wanted.length !== parent.children.length || wanted.some((each, i) => each !== parent.children[i]))
        parent.replaceChildren(...wanted);
    this.elements = kept;
    const focused = kept.get(`id ${focus}`);
    if (focused) this.canvas.setAttribute('aria-activedescendant', focused.id);
    else this.canvas.removeAttribute('aria-activedescendant');
    if (dialog && dialog !== this.dialog)
      this.tell(children.get(dialog).filter(each => each.tagName === 'P').map(each => each.textContent).join('\n'));
    this.dialog = dialog;
  }

  /// The element of an item is the same as long as the item is there, so that the screen reader keeps
  /// its place.
  element(item, kept) {
    let key = item.id ? `id ${item.id}` : `${item.role} ${item.name}`;
    while (kept.has(key)) key += ' again';
    const element = this.elements.get(key) ?? document.createElement(item.role === 'text' ? 'p' : 'div');
    kept.set(key, element);
    if (item.role === 'text') element.textContent = item.name;
    else this.describe(element, item);
    return element;
  }

  describe(element, item) {
    const set = (name, value) => {
      if (value === undefined) element.removeAttribute(name);
      else if (element.getAttribute(name) !== String(value)) element.setAttribute(name, value);
    };
    set('role', kAria[item.role]);
    set('aria-label', item.name);
    set('aria-disabled', item.disabled);
    set('aria-checked', item.role === 'checkbox' ? item.on : undefined);
    set('aria-expanded', item.role === 'header' ? item.on : item.role === 'choice' ? false : undefined);
    set('aria-keyshortcuts', item.role === 'button' ? item.value?.replaceAll('Ctrl', 'Control') : undefined);
    set('aria-valuetext', item.role === 'slider' ? item.value : undefined);
    set('aria-valuenow', item.role === 'slider' ? parseFloat(item.value) || 0 : undefined);
    if (item.role === 'field' || item.role === 'choice') element.textContent = item.value ?? '';
    if (!item.id || element.id) return;
    element.id = 'control-' + item.id;
    element.addEventListener('click', () => this.press(item.id));
  }
}
