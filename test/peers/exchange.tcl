# SPDX-License-Identifier: MIT
# ns exchange.tcl old|new FILE: four nodes in a row, 200 m apart, which hear 250 m, with the lines
# of the MAC. At 1 s the second broadcasts; at 2 s it sends to the third, which answers at 3 s. Every
# unicast asks with an RTS. What they say before 0.9 s is for ARP.
lassign $argv format file

set simulator [new Simulator]
if {$format eq "new"} { $simulator use-newtrace }
$simulator trace-all [open $file w]
set topography [new Topography]
$topography load_flatgrid 1000 100
create-god 4
Mac/802_11 set RTSThreshold_ 0
$simulator node-config -adhocRouting DumbAgent -llType LL -macType Mac/802_11 \
    -ifqType Queue/DropTail/PriQueue -ifqLen 50 -antType Antenna/OmniAntenna \
    -propType Propagation/TwoRayGround -phyType Phy/WirelessPhy \
    -channel [new Channel/WirelessChannel] -topoInstance $topography \
    -agentTrace ON -routerTrace ON -macTrace ON -movementTrace OFF

for {set i 0} {$i < 4} {incr i} {
    set node [$simulator node]
    $node set X_ [expr {10.0 + 200 * $i}]
    $node set Y_ 50.0
    $node set Z_ 0.0
    set agent($i) [new Agent/MessagePassing]
    $node attach $agent($i) 42
}
Agent/MessagePassing instproc recv {source sport size data} {}

$simulator at 0.5 {$agent(1) sendto 1 F 2 42}
$simulator at 1.0 {$agent(1) sendto 64 F -1 42}
$simulator at 2.0 {$agent(1) sendto 500 F 2 42}
$simulator at 3.0 {$agent(2) sendto 100 F 1 42}
$simulator at 4.0 {$simulator flush-trace; exit 0}
$simulator run
