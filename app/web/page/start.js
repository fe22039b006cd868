// The first script of the page: reports a script that the browser did not get or cannot read. Old
// browsers run it too, so it is in their JavaScript.
'use strict';

window.addEventListener('error', function (event) {
  var message = document.getElementById('message');
  if (message.textContent !== 'Loading...') return;
  var lost = event.target.src;
  var name = (lost || event.filename || '').split('/').pop();
  message.textContent = lost ? 'Claystack could not start: ' + name + ' could not be loaded'
    : 'This browser cannot run ' + name + ' (' + event.message +
      '). Claystack needs a recent Chromium, Firefox or Safari.';
}, true);  // a script's own event reaches the window only on its way down
