// Keys of a keyboard, and the keyboard on the screen of a phone.
'use strict';

const kTapFrames = 4;             // until a tap has reached a text field
const kPad = '\u200b', kPads = 8;  // invisible characters, for the key Backspace to delete

const kKeys = {Escape: 256, Enter: 257, Tab: 258, Backspace: 259, Insert: 260, Delete: 261,
  ArrowRight: 262, ArrowLeft: 263, ArrowDown: 264, ArrowUp: 265, PageUp: 266, PageDown: 267,
  Home: 268, End: 269, ' ': 32, '?': 47, '+': 61};  // the last two: the keys of / and =

/// AltGr, which Windows reports as Ctrl and Alt, writes characters.
function writes(event) {
  return event.getModifierState('AltGraph') || !(event.ctrlKey || event.metaKey || event.altKey);
}

/// The code of GLFW; -1: the program does not use the key.
function codeOf(event) {
  if (event.key in kKeys) return kKeys[event.key];
  const f = /^F(\d+)$/.exec(event.key);
  if (f) return 289 + Number(f[1]);
  return event.key.length === 1 && event.key < '\x7f' ? event.key.toUpperCase().charCodeAt(0) : -1;
}

let keyboard = null;

const held = new Set();  // codes
function key(code, pressed, repeated, mods) {
  if (pressed) held.add(code); else held.delete(code);
  studio._claystack_key(code, pressed, repeated, mods);
  ask();
}

function listenToKeys() {
  keyboard = new ScreenKeyboard(by('typed'), {
    typing() { return studio._claystack_typing(); },
    frame() { frame(performance.now()); },
    text(character) { studio._claystack_text(character); ask(); },
    backspace() { for (const pressed of [true, false]) key(kKeys.Backspace, pressed, false, 0); },
    leave() { canvas.focus(); },
  });
  const release = () => { for (const code of [...held]) key(code, false, false, 0); };
  const keyDown = event => {
    const code = codeOf(event), control = event.ctrlKey || event.metaKey;
    // Tab goes on to the buttons of the page, unless a dialog or menu uses it.
    if (event.key === 'Tab' && (event.shiftKey || !studio._claystack_dialog_open())) return;
    if (control && code === 86) return;  // the event `paste` follows
    // Leaves the page's own keys to the browser: reload, developer tools, tabs. In a dialog Ctrl+R
    // recovers or replaces.
    if (control && (/^[tnwl]$/i.test(event.key) || (/^r$/i.test(event.key) && !studio._claystack_dialog_open())))
      return;
    if (code >= 0) key(code, true, event.repeat, mods(event));
    const character = writes(event) && event.key.length === 1;
    if (character) studio._claystack_text(event.key.codePointAt(0));
    ask();
    const taken = character || (code >= 0 && !/^F(5|11|12)$/.test(event.key));
    if (taken) event.preventDefault();
  };
  const keyUp = event => {
    const code = codeOf(event);
    if (code >= 0) key(code, false, false, mods(event));
    if (event.key === 'Meta') release();  // macOS reports no other key that goes up before it
  };
  for (const field of [canvas, by('typed')]) {
    field.addEventListener('keydown', keyDown);
    field.addEventListener('keyup', keyUp);
    field.addEventListener('blur', release);
  }
  document.addEventListener('paste', event => {
    if (document.activeElement !== canvas) return;
    withText(event.clipboardData.getData('text'), text => studio._claystack_paste(text));
    for (const pressed of [true, false]) key(86, pressed, false, kControl);
  });
}

// ---- on the screen -----------------------------------------------------------------------------

/// Browsers show the keyboard only for a field of the page, so a hidden field has the focus while a
/// text field of the window takes characters.
/// `window`: {typing(), frame(), text(character), backspace(), leave()}.
class ScreenKeyboard {
  constructor(field, window) {
    this.field = field;
    this.window = window;
    this.before = '';
    field.addEventListener('input', () => this.changed());
  }

  /// A finger has left the window. Safari shows the keyboard only if the field gets the focus within
  /// this event, so the frames that take the tap do not wait.
  tapped() {
    for (let i = 0; i < kTapFrames && !this.window.typing(); ++i) this.window.frame();
    if (!this.window.typing()) return;
    this.field.value = kPad.repeat(kPads);
    this.before = '';
    this.field.focus();
  }

  /// After each frame.
  follow() {
    if (document.activeElement === this.field && !this.window.typing()) this.window.leave();
  }

  /// A keyboard that corrects a word replaces all of it: sends only the changed characters.
  changed() {
    const now = this.field.value.replaceAll(kPad, '');
    let same = 0;
    while (same < this.before.length && now[same] === this.before[same]) ++same;
    let deleted = this.before.length - same;
    if (now === '' && this.before === '') {  // deletes text that the field of the window had before
      deleted = kPads - this.field.value.length;
      this.field.value = kPad.repeat(kPads);
    }
    for (let i = 0; i < deleted; ++i) this.window.backspace();
    for (const character of now.slice(same)) this.window.text(character.codePointAt(0));
    this.before = now;
  }
}
