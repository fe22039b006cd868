// Gamepads, and 3Dconnexion controllers by WebHID. The program decodes the reports.
'use strict';

// ---- gamepads ----------------------------------------------------------------------------------

const kPadMs = 16;
// The buttons of the standard layout in the order of the program; its triggers are 6 and 7.
const kPadButtons = [0, 1, 2, 3, 4, 5, 8, 9, 16, 10, 11, 12, 15, 13, 14];

let padTimer = 0, padName = '', padState = '';

const nameOf = pad => pad?.id.replace(/ *\(.*/, '') ?? '';

function readPad() {
  const pad = [...navigator.getGamepads()].find(pad => pad?.connected && pad.mapping === 'standard');
  const name = nameOf(pad);
  if (name !== padName) {
    padName = name;
    padState = '';
    withText(name, text => studio._claystack_gamepad_plugged(text));
    ask();
  }
  if (!pad) {
    clearInterval(padTimer);
    padTimer = 0;
    return;
  }
  const [leftX, leftY, rightX, rightY] = pad.axes, pulled = index => pad.buttons[index]?.value ?? 0;
  const buttons = kPadButtons.reduce((bits, index, i) => bits | (pad.buttons[index]?.pressed ? 1 << i : 0), 0);
  const state = [leftX, -leftY, rightX, -rightY, pulled(6), pulled(7), buttons];
  if (state.join() === padState) return;
  padState = state.join();
  studio._claystack_gamepad(...state);
  ask();
}

/// Reads nothing until a gamepad is connected.
function listenToGamepads() {
  if (!navigator.getGamepads) return;
  window.addEventListener('gamepadconnected', ({gamepad}) => {
    if (gamepad.mapping !== 'standard')
      return status(`${nameOf(gamepad)}: the browser knows no layout for this gamepad, so it cannot be used`);
    padTimer ||= setInterval(readPad, kPadMs);
  });
}

// ---- 3Dconnexion controllers -------------------------------------------------------------------

let mouse3d = null;

async function connectHid(device) {
  if (mouse3d) return;
  mouse3d = device;  // at once: a controller may have several parts, each a separate device
  try {
    if (!device.opened) await device.open();
  } catch (error) {
    mouse3d = null;
    return status(`${device.productName}: could not be opened: ${error.message}`);
  }
  if (!studio._claystack_hid_plugged(device.vendorId, device.productId)) {
    mouse3d = null;
    return device.close();
  }
  device.oninputreport = ({reportId, data}) => {
    const report = Uint8Array.of(reportId, ...new Uint8Array(data.buffer, data.byteOffset, data.byteLength));
    const place = room(report.length);
    studio.HEAPU8.set(report, place);
    studio._claystack_hid_report(place, report.length);
    studio._free(place);
    ask();
  };
  ask();
}

/// Only Chromium offers WebHID. A controller that was permitted once connects by itself.
async function listenToHid() {
  const hid = navigator.hid;
  if (!hid) return;
  const filters = JSON.parse(studio.UTF8ToString(studio._claystack_hid_filters()));
  const known = device => filters.some(filter =>
    filter.vendorId === device.vendorId && filter.productId === device.productId);
  by('hid').hidden = matchMedia('(pointer: coarse)').matches;  // not on a phone
  by('hid').onclick = async () => {
    try {
      for (const device of await hid.requestDevice({filters})) await connectHid(device);
    } catch (error) {
      status('No controller was connected: ' + error.message);
    }
    canvas.focus();
  };
  hid.addEventListener('connect', ({device}) => { if (known(device)) connectHid(device); });
  hid.addEventListener('disconnect', ({device}) => {
    if (device !== mouse3d) return;
    mouse3d = null;
    studio._claystack_hid_unplugged();
    ask();
  });
  for (const device of await hid.getDevices()) if (known(device)) connectHid(device);
}
