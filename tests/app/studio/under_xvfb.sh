#!/bin/sh
# under_xvfb.sh PROGRAM FOLDER: the window on a screen of its own, with real events: from the gallery
# to files that print. Prints the log.
set -u
. "$(dirname "$0")/under_xvfb_start.sh"

# What the title says: the name, and a star while it is not saved.
has_title() { [ "$(xdotool getwindowname "$window")" = "$1" ]; }
until_title() { wait_until "the title $1" has_title "$1"; }

throw_the_bowl
until_title "*bowl - Claystack"
# Ten short taps are ten undos and redos: none is lost.
for i in 1 2 3 4 5; do
  xdotool key --window "$window" --delay 0 ctrl+z
  xdotool key --window "$window" --delay 0 ctrl+shift+z
done
until_line "action: edit.redo" 5
[ "$(grep -c "action: edit.undo" "$log")" -eq 5 ] || fail "expected 5 undos"
# An export by its shortcut: the name is the sample's, the folder that of the last file, here the
# one that the window was started in.
xdotool key --window "$window" ctrl+e
until_line "export previewed"
xdotool key --window "$window" ctrl+Return
until_line "exported: .*bowl.3mf"
[ -s bowl.3mf ] || fail "expected bowl.3mf"
mv bowl.3mf by_key.3mf
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force"
# The same by the menu: File, then Export.
xdotool mousemove --window "$window" 27 13 click 1
xdotool mousemove --window "$window" 60 240 sleep 0.2 click 1
until_line "action: file.export" 2
until_line "export previewed" 2
xdotool key --window "$window" ctrl+Return
until_line "exported: .*bowl.3mf" 2
cmp bowl.3mf by_key.3mf || fail "expected the same bytes by menu and by key"
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force" 2
# Larger text is kept: the test looks at the file.
xdotool key --window "$window" ctrl+equal
until_line "action: view.larger"
xdotool key --window "$window" ctrl+q
until_line "prompt: quit"
xdotool key --window "$window" Escape
until_line "action: wheel.zero_force" 3
# The window's own way out asks again.
xdotool key --window "$window" ctrl+q
until_line "prompt: quit" 2
xdotool key --window "$window" ctrl+d
until_line "window closed"
until_ended
cat "$log"
