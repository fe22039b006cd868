// The window as a screen reader gets it: the tree of names, roles and states that the browser makes
// of the hidden elements in the canvas.
import assert from 'node:assert/strict';
import {closeClean, chord, pause} from './browser.mjs';

/// All nodes of the tree below the canvas.
async function tree(page) {
  const root = await page.$('#canvas');
  const all = [];
  const add = node => { all.push(node); for (const child of node.children ?? []) add(child); };
  const found = await page.accessibility.snapshot({root, interestingOnly: false});
  if (found) add(found);
  return all;
}

/// The node, as soon as the tree has it. `expected`: members of the node.
async function node(page, expected) {
  const matches = each => Object.entries(expected).every(([name, value]) =>
    value instanceof RegExp ? value.test(String(each[name])) : each[name] === value);
  let all = [];
  for (let i = 0; i < 100; ++i, await pause(200)) {
    all = await tree(page);
    const found = all.find(matches);
    if (found) return found;
  }
  const named = all.filter(each => each.name).map(each => `${each.role} '${each.name}'`);
  return assert.fail(`expected ${JSON.stringify(Object.fromEntries(Object.entries(expected).map(([k, v]) =>
    [k, String(v)])))} in: ${named.join(', ')}`);
}

/// As a screen reader presses a control: without the pointer.
const press = (page, name) => page.evaluate(name =>
  [...document.querySelectorAll('#canvas [aria-label]')].find(e => e.getAttribute('aria-label').startsWith(name)).click(),
  name);

/// The name of the control that has the keyboard.
async function focused(page, name) {
  await page.waitForFunction(name => {
    const id = document.getElementById('canvas').getAttribute('aria-activedescendant');
    return id && document.getElementById(id).getAttribute('aria-label') === name;
  }, {timeout: 20000}, name).catch(async () => assert.equal(await page.evaluate(() => {
    const id = document.getElementById('canvas').getAttribute('aria-activedescendant');
    return id && document.getElementById(id).getAttribute('aria-label');
  }), name));
}

/// The gallery, tools, menus, a slider and a dialog, read and pressed.
export async function readAndPressed({open}) {
  const page = await open();
  await page.says('window open');
  await node(page, {role: 'dialog', name: 'gallery'});
  await node(page, {role: 'button', name: /^Bowl\. ./});
  assert.ok(!(await tree(page)).some(each => each.name === 'Pinch'), 'expected nothing beside a dialog');
  await page.shows('opened', /./);
  await press(page, 'Throw it');
  await page.says('work started: ');
  await page.says('checked: proved');

  await node(page, {role: 'checkbox', name: 'Press', checked: true});
  await press(page, 'Pinch');
  await page.says('tool.pinch');
  await node(page, {role: 'checkbox', name: 'Pinch', checked: true});
  await node(page, {role: 'slider', name: 'Radius', value: 10});
  assert.equal(await page.$eval('[aria-label="Radius"]', e => e.getAttribute('aria-valuetext')), '10.0 mm');
  await node(page, {role: 'combobox', name: 'Material'});
  assert.equal(await page.$eval('[aria-label="Material"]', e => e.textContent), 'Wet clay');
  await node(page, {role: 'StaticText', name: 'Presses from both sides of the wall: drag up to pull it.'});
  await node(page, {role: 'button', name: 'Goal'});
  assert.equal(await page.$eval('[aria-label="Goal"]', e => e.getAttribute('aria-expanded')), 'false');
  await press(page, 'Goal');
  await page.waitForFunction(() =>
    document.querySelector('[aria-label="Goal"]').getAttribute('aria-expanded') === 'true', {timeout: 20000});

  await page.focus('#canvas');
  await page.keyboard.press('F10');
  await focused(page, 'New...');
  await page.keyboard.press('ArrowUp');  // the first arrow key may only show the place
  await page.keyboard.press('Home');
  await focused(page, 'New...');
  await page.keyboard.press('ArrowDown');
  await focused(page, 'Throw a bowl');
  assert.equal(await page.$eval('[aria-label="Open..."]', e => e.getAttribute('aria-keyshortcuts')), 'Control+O');
  await page.keyboard.press('Escape');

  await chord(page, 'KeyE', 'Control');
  await node(page, {role: 'dialog', name: 'export'});
  await page.shows('opened', /Export/);
  await node(page, {role: 'checkbox', name: 'STL', checked: false});
  await press(page, 'STL');
  await node(page, {role: 'checkbox', name: 'STL', checked: true});
  await node(page, {role: 'textbox', name: 'Name'});
  await closeClean(page);
}
