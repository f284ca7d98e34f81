# SPDX-License-Identifier: MIT
# ns chain.tcl old|new FILE: three nodes in a row. The first broadcasts one message; DumbAgent hands
# it up at the second and forwards nothing.
source [file join [file dirname [info script]] row.tcl]
make_row 3 OFF

$simulator at 1.0 {$agent(0) sendto 64 F -1 42}
$simulator at 2.0 {$simulator flush-trace; exit 0}
$simulator run
