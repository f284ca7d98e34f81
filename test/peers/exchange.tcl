# SPDX-License-Identifier: MIT
# ns exchange.tcl old|new FILE: four nodes in a row, with the lines of the MAC. At 1 s the second
# broadcasts; at 2 s it sends to the third, which answers at 3 s. Every unicast asks with an RTS. What
# they say before 0.9 s is for ARP.
source [file join [file dirname [info script]] row.tcl]
Mac/802_11 set RTSThreshold_ 0
make_row 4 ON

$simulator at 0.5 {$agent(1) sendto 1 F 2 42}
$simulator at 1.0 {$agent(1) sendto 64 F -1 42}
$simulator at 2.0 {$agent(1) sendto 500 F 2 42}
$simulator at 3.0 {$agent(2) sendto 100 F 1 42}
$simulator at 4.0 {$simulator flush-trace; exit 0}
$simulator run
