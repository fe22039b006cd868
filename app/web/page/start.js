// The first script of the page: sets the first colours, and reports a script that the browser could
// not load or cannot read. Old browsers run it too, so it uses old JavaScript.
'use strict';

// Until the program sets its theme.
document.documentElement.setAttribute('data-theme',
  window.matchMedia && matchMedia('(prefers-color-scheme: light)').matches ? 'light' : 'dark');

window.addEventListener('error', function (event) {
  var message = document.getElementById('message');
  var lost = event.target.tagName === 'SCRIPT';
  var file = lost ? event.target.src : event.filename || '';
  // A missing style sheet and errors in scripts of extensions do not prevent the start.
  if (message.textContent !== 'Loading...' || file.indexOf(location.origin) !== 0) return;
  var name = file.split('/').pop();
  message.textContent = lost ? 'Claystack could not start: ' + name + ' could not be loaded'
    : 'This browser cannot run ' + name + ' (' + event.message +
      '). Claystack needs a recent Chromium, Firefox or Safari.';
}, true);  // the window receives a script's load error only in the capture phase
