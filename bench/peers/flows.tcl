# SPDX-License-Identifier: MIT
# The flows of bench/peers/run in ns-2.35; prints one line of JSON.
#   ns flows.tcl -cell FILE [-sense 250] [-rate 1] [-payload 1000] [-seconds 20] [-seed 1]
# FILE has lines "node X Y" [m] and "flow FROM TO". Each flow always has a unicast of that payload [B]
# to send. Two-ray ground at 914 MHz, decoded to 250 m, sensed to -sense [m]. The rate [Mb/s] is that
# of data; ns-2 answers at its basic rate, 1 Mb/s.

source [file join [file dirname [info script]] ns2.tcl]

array set option {-cell "" -sense 250 -rate 1 -payload 1000 -seconds 20 -seed 1}
read_options option $argv

# The places of the nodes, and the flows.
proc read_cell {path} {
    global places flows
    set file [open $path]
    while {[gets $file line] >= 0} {
        lassign $line what a b
        if {$what eq "node"} {lappend places [list $a $b]} else {lappend flows [list $a $b]}
    }
    close $file
}

# More frames than an otherwise empty channel could take.
proc saturate {flow from to start} {
    global ns_ node_ sink option
    set sink($flow) [new Agent/LossMonitor]
    $ns_ attach-agent $node_($to) $sink($flow)
    set source [new Agent/UDP]
    $source set packetSize_ 2000
    $ns_ attach-agent $node_($from) $source
    $ns_ connect $source $sink($flow)
    $ns_ at [expr {0.02 * $flow}] "$source send 10"
    set traffic [new Application/Traffic/CBR]
    $traffic set packetSize_ $option(-payload)
    $traffic set interval_ [expr {($option(-payload) + 34) * 8 / ($option(-rate) * 1e6)}]
    $traffic attach-agent $source
    $ns_ at $start "$traffic start"
}

proc finish {} {
    global option sink before flows
    set each {}
    set sum 0
    for {set f 0} {$f < [llength $flows]} {incr f} {
        set got [expr {[$sink($f) set npkts_] - $before($f)}]
        incr sum $got
        lappend each [format %.2f [expr {double($got) / $option(-seconds)}]]
    }
    puts [format {{"peer": "ns2", "frames_per_s": %.2f, "by_flow": [%s]}} \
        [expr {double($sum) / $option(-seconds)}] [join $each ", "]]
    exit 0
}

if {$option(-cell) eq ""} {
    puts stderr "flows.tcl: the option -cell is missing; expected -cell FILE"
    exit 2
}
read_cell $option(-cell)
Mac/802_11 set dataRate_ $option(-rate)Mb
Mac/802_11 set basicRate_ 1Mb
Mac/802_11 set RTSThreshold_ 3000
# Power falls with the fourth power of the distance; ns-2's own threshold is that of 550 m.
Phy/WirelessPhy set CSThresh_ [expr {3.652e-10 * pow(250.0 / $option(-sense), 4)}]

set ns_ [new Simulator]
ns-random $option(-seed)
wireless [llength $places] [open /dev/null w] OFF OFF
set i 0
foreach place $places {
    set node_($i) [$ns_ node]
    $node_($i) random-motion 0
    $node_($i) set X_ [expr {1000 + [lindex $place 0]}]
    $node_($i) set Y_ [expr {1000 + [lindex $place 1]}]
    $node_($i) set Z_ 0
    incr i
}
set full [expr {0.02 * [llength $flows] + 0.5}]
set f 0
foreach flow $flows {
    saturate $f [lindex $flow 0] [lindex $flow 1] [expr {$full + 0.001 * $f}]
    incr f
}
$ns_ at [expr {$full + 1}] {foreach f [array names sink] {set before($f) [$sink($f) set npkts_]}}
$ns_ at [expr {$full + 1 + $option(-seconds)}] finish
$ns_ run
