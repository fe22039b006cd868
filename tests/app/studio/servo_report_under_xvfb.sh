#!/bin/sh
# servo_report_under_xvfb.sh PROGRAM FOLDER SCENE SECONDS: what the window says of itself and the servo.
set -u
. "$(dirname "$0")/under_xvfb_start.sh"
LD_PRELOAD=$emulation "$program" studio "$3" --servo-report "$4" --json
