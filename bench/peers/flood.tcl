# SPDX-License-Identifier: MIT
# The flood of bench/peers/run in ns-2.35; prints one line of JSON.
#   ns flood.tcl -movement FILE [-messages 20] [-interval 3] [-ttl 100] [-jitter 0.05] [-payload 64]
#                [-seed 1] [-trace FILE]
# Message k leaves node 37 k mod N at 1 s + k * interval. Who first hears it re-sends it after
# 1 us + U(0, jitter), as in rovernet, while its TTL is above 1; copies of a known message are counted
# and go no further.
# 802.11 at 1 Mb/s with ns-2's own defaults: two-ray ground at 914 MHz, decoded to 250 m, sensed and
# interfering to 550 m. -trace writes the lines of agents and MAC; without it nothing is written.

source [file join [file dirname [info script]] ns2.tcl]

array set option {-movement "" -messages 20 -interval 3 -ttl 100 -jitter 0.05 -payload 64 -seed 1
    -trace ""}
read_options option $argv

# As many nodes as the file places.
proc count_nodes {movement} {
    set file [open $movement]
    set nodes [regexp -all -line {^\$node_\([0-9]+\) set X_ } [read $file]]
    close $file
    return $nodes
}

Class Agent/MessagePassing/Flood -superclass Agent/MessagePassing

# content: message and TTL
Agent/MessagePassing/Flood instproc recv {source port size content} {
    global receptions known delivered
    incr receptions
    lassign $content message ttl
    $self instvar id
    if {[info exists known($message,$id)]} return
    set known($message,$id) 1
    incr delivered($message)
    if {$ttl > 1} {
        global ns_ delay
        $ns_ at [expr {[$ns_ now] + [$delay value]}] "$self flood $message [expr {$ttl - 1}]"
    }
}

Agent/MessagePassing/Flood instproc flood {message ttl} {
    global option transmissions
    incr transmissions
    $self sendto $option(-payload) "$message $ttl" -1 42
}

proc begin {message} {
    global nodes agent known option
    set origin [expr {37 * $message % $nodes}]
    set known($message,$origin) 1
    $agent($origin) flood $message $option(-ttl)
}

proc finish {} {
    global option nodes transmissions receptions delivered ready
    set others [expr {$nodes - 1.0}]
    set sum 0
    set each {}
    for {set k 0} {$k < $option(-messages)} {incr k} {
        incr sum $delivered($k)
        lappend each [format %.6f [expr {$delivered($k) / $others}]]
    }
    puts [format {{"peer": "ns2", "nodes": %d, "messages": %d, "delivery_ratio": %.6f,\
        "transmissions": %d, "receptions": %d, "setup_cpu_s": %.4f, "run_cpu_s": %.4f,\
        "rss_mb": %.1f, "delivery_by_message": [%s]}} \
        $nodes $option(-messages) [expr {$sum / $others / $option(-messages)}] \
        $transmissions $receptions $ready [expr {[cpu_s] - $ready}] [rss_mb] [join $each ", "]]
    exit 0
}

set nodes [count_nodes $option(-movement)]
if {$nodes == 0} {
    puts stderr "flood.tcl: the movement file \"$option(-movement)\" has no node; expected -movement FILE"
    exit 2
}
set ns_ [new Simulator]
ns-random $option(-seed)
set delay [new RandomVariable/Uniform]
$delay set min_ 1e-6
$delay set max_ [expr {1e-6 + $option(-jitter)}]

if {$option(-trace) eq ""} {
    wireless $nodes [open /dev/null w] OFF OFF
} else {
    wireless $nodes [open $option(-trace) w] ON ON
}
for {set i 0} {$i < $nodes} {incr i} {
    set node_($i) [$ns_ node]
    $node_($i) random-motion 0
    set agent($i) [new Agent/MessagePassing/Flood]
    $agent($i) set id $i
    $node_($i) attach $agent($i) 42
}
source $option(-movement)

set transmissions 0
set receptions 0
for {set k 0} {$k < $option(-messages)} {incr k} {
    set delivered($k) 0
    $ns_ at [expr {1 + $k * $option(-interval)}] "begin $k"
}
$ns_ at [expr {1 + $option(-messages) * $option(-interval) + 2}] finish
set ready [cpu_s]
$ns_ run
