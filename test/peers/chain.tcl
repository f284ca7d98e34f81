# SPDX-License-Identifier: MIT
# ns chain.tcl old|new FILE: three nodes in a row, 200 m apart, which hear 250 m. The first
# broadcasts one message; DumbAgent hands it up at the second and forwards nothing.
lassign $argv format file

set simulator [new Simulator]
if {$format eq "new"} { $simulator use-newtrace }
$simulator trace-all [open $file w]
set topography [new Topography]
$topography load_flatgrid 500 100
create-god 3
$simulator node-config -adhocRouting DumbAgent -llType LL -macType Mac/802_11 \
    -ifqType Queue/DropTail/PriQueue -ifqLen 50 -antType Antenna/OmniAntenna \
    -propType Propagation/TwoRayGround -phyType Phy/WirelessPhy \
    -channel [new Channel/WirelessChannel] -topoInstance $topography \
    -agentTrace ON -routerTrace ON -macTrace OFF -movementTrace OFF

for {set i 0} {$i < 3} {incr i} {
    set node [$simulator node]
    $node set X_ [expr {10.0 + 200 * $i}]
    $node set Y_ 50.0
    $node set Z_ 0.0
    set agent($i) [new Agent/MessagePassing]
    $node attach $agent($i) 42
}
Agent/MessagePassing instproc recv {source sport size data} {}

$simulator at 1.0 {$agent(0) sendto 64 F -1 42}
$simulator at 2.0 {$simulator flush-trace; exit 0}
$simulator run
