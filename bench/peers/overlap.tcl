# SPDX-License-Identifier: MIT
# Frames that overlap at one receiver, for bench/peers/overlap, in ns-2.35.
#   ns overlap.tcl -nodes FILE -frames FILE -trace FILE
# A line of the file of nodes has x [m], y [m] and the power [W] of a node. Node 0 receives; the
# others hear nothing, and therefore send at once but for a backoff. A line of the file of frames has
# the time [s], the node and the payload [B].

source [file join [file dirname [info script]] ns2.tcl]

array set option {-nodes "" -frames "" -trace ""}
read_options option $argv

proc lines {file} {
    set channel [open $file]
    return [split [string trim [read $channel]] \n]
}

Agent/MessagePassing instproc recv args {}

set ns_ [new Simulator]
set positions [lines $option(-nodes)]
wireless [llength $positions] [open $option(-trace) w] ON OFF
set count 0
foreach position $positions {
    lassign $position x y power
    Phy/WirelessPhy set Pt_ $power
    set node_($count) [$ns_ node]
    $node_($count) random-motion 0
    $node_($count) set X_ $x
    $node_($count) set Y_ $y
    $node_($count) set Z_ 0
    set agent($count) [new Agent/MessagePassing]
    $node_($count) attach $agent($count) 42
    # Not before the first frame: with it, ns-2 derives from this threshold how far frames go.
    if {$count > 0} {$ns_ at 0.5 "[$node_($count) set netif_(0)] set CSThresh_ 1e30"}
    incr count
}
$ns_ at 0.1 "$agent(0) sendto 10 x -1 42"
foreach frame [lines $option(-frames)] {
    lassign $frame time node payload
    $ns_ at $time "$agent($node) sendto $payload x -1 42"
}
$ns_ at [expr {$time + 1}] "exit 0"
$ns_ run
