# SPDX-License-Identifier: MIT
# ns motion.tcl SCENE NODES END EVERY FILE: the nodes of a movement file, moved by ns-2. Writes
# "time node x y" for every node every EVERY seconds until END.
lassign $argv scene nodes end every file

set ns_ [new Simulator]
$ns_ trace-all [open /dev/null w]
set topography [new Topography]
$topography load_flatgrid 1000 1000
create-god $nodes
$ns_ node-config -adhocRouting DumbAgent -llType LL -macType Mac/802_11 \
    -ifqType Queue/DropTail/PriQueue -ifqLen 50 -antType Antenna/OmniAntenna \
    -propType Propagation/TwoRayGround -phyType Phy/WirelessPhy -channel [new Channel/WirelessChannel] \
    -topoInstance $topography -agentTrace OFF -routerTrace OFF -macTrace OFF -movementTrace OFF
for {set i 0} {$i < $nodes} {incr i} {
    set node_($i) [$ns_ node]
    $node_($i) random-motion 0
}
source $scene

set out [open $file w]
proc note {} {
    global ns_ node_ nodes every out
    for {set i 0} {$i < $nodes} {incr i} {
        $node_($i) log-movement
        puts $out [format "%.9f %d %.9f %.9f" [$ns_ now] $i [$node_($i) set X_] [$node_($i) set Y_]]
    }
    $ns_ at [expr {[$ns_ now] + $every}] note
}
$ns_ at 0.0 note
$ns_ at $end {close $out; exit 0}
$ns_ run
