# SPDX-License-Identifier: MIT
# Nodes in a row, 200 m apart, which hear 250 m: sourced by chain.tcl and exchange.tcl.
lassign $argv format file

set simulator [new Simulator]
if {$format eq "new"} { $simulator use-newtrace }
$simulator trace-all [open $file w]
Agent/MessagePassing instproc recv {source sport size data} {}

# Makes `count` of them, with an agent each in the array `agent`; mac_trace: ON or OFF.
proc make_row {count mac_trace} {
    global simulator agent
    set topography [new Topography]
    $topography load_flatgrid 1000 100
    create-god $count
    $simulator node-config -adhocRouting DumbAgent -llType LL -macType Mac/802_11 \
        -ifqType Queue/DropTail/PriQueue -ifqLen 50 -antType Antenna/OmniAntenna \
        -propType Propagation/TwoRayGround -phyType Phy/WirelessPhy \
        -channel [new Channel/WirelessChannel] -topoInstance $topography \
        -agentTrace ON -routerTrace ON -macTrace $mac_trace -movementTrace OFF
    for {set i 0} {$i < $count} {incr i} {
        set node [$simulator node]
        $node set X_ [expr {10.0 + 200 * $i}]
        $node set Y_ 50.0
        $node set Z_ 0.0
        set agent($i) [new Agent/MessagePassing]
        $node attach $agent($i) 42
    }
}
