#!/bin/sh
# servo_report_under_xvfb.sh PROGRAM FOLDER SCENE SECONDS: runs the window and prints its report.
set -u
. "$(dirname "$0")/under_xvfb_start.sh"
LD_PRELOAD=$emulation "$program" studio "$3" --servo-report "$4" --json
