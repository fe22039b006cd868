#!/bin/sh
# under_xvfb.sh PROGRAM FOLDER: the window on a virtual screen with real events, from the
# gallery to a printable file. Prints the log.
set -u
. "$(dirname "$0")/under_xvfb_start.sh"

# The title is the name, with a star while it is not saved.
has_title() { [ "$(xdotool getwindowname "$window")" = "$1" ]; }
until_title() { wait_until "the title $1" has_title "$1"; }

throw_the_bowl
until_title "*bowl - Claystack"
# Ten key taps without delay: none is lost.
for i in 1 2 3 4 5; do
  xdotool key --window "$window" --delay 0 ctrl+z
  xdotool key --window "$window" --delay 0 ctrl+shift+z
done
until_line "action: edit.redo" 5
[ "$(grep -c "action: edit.undo" "$log")" -eq 5 ] || fail "expected 5 undos"
# Export by shortcut. The name is that of the sample; the folder is that of the last file, here the
# working folder.
xdotool key --window "$window" ctrl+e
until_line "export previewed"
xdotool key --window "$window" ctrl+Return
until_line "exported: .*bowl.3mf"
[ -s bowl.3mf ] || fail "expected bowl.3mf"
mv bowl.3mf by_key.3mf
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force"
# Export by the menu: File, then Export.
xdotool mousemove --window "$window" 27 13 click 1
xdotool mousemove --window "$window" 60 401 sleep 0.2 click 1
until_line "action: file.export" 2
until_line "export previewed" 2
xdotool key --window "$window" ctrl+Return
until_line "exported: .*bowl.3mf" 2
cmp bowl.3mf by_key.3mf || fail "expected the same bytes by menu and by key"
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force" 2
# The same by the keyboard: the last row of the menu File is Quit, then Settings, then Export. The
# pointer leaves the menu, because the keys continue from the row under the pointer.
xdotool mousemove --window "$window" 640 300 sleep 0.3
xdotool key --window "$window" F10
until_line "action: help.menu"
for key in Up Up Up Up Up Return; do
  xdotool key --window "$window" "$key" sleep 0.1
done
until_line "action: file.export" 3
until_line "export previewed" 3
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force" 3
# The larger text is saved; the test checks the settings file.
xdotool key --window "$window" ctrl+equal
until_line "action: view.larger"
xdotool key --window "$window" ctrl+q
until_line "prompt: quit"
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force" 4
# Quitting again asks again.
xdotool key --window "$window" ctrl+q
until_line "prompt: quit" 2
xdotool key --window "$window" ctrl+d
until_line "window closed"
until_ended
cat "$log"
