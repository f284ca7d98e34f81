# SPDX-License-Identifier: MIT
# The saturated cell of bench/peers/run in ns-2.35; prints one line of JSON.
#   ns cell.tcl [-n 10] [-mode unicast|rts|broadcast] [-rate 1] [-payload 1000] [-seconds 20] [-seed 1]
# n stations and one silent sink share a place, so that no frame captures another. Each station
# always has a frame of that payload [B] for the sink, or for all. The rate [Mb/s] is that of data;
# ns-2 sends broadcasts and control frames at its basic rate, 1 Mb/s. A station first learns the
# sink's address: in a saturated cell the ARP requests themselves would take the channel.

source [file join [file dirname [info script]] ns2.tcl]

array set option {-n 10 -mode unicast -rate 1 -payload 1000 -seconds 20 -seed 1}
read_options option $argv

proc send_to_sink {station} {
    global ns_ node_ sink option
    set source [new Agent/UDP]
    $source set packetSize_ 2000
    $ns_ attach-agent $node_($station) $source
    if {$option(-mode) eq "broadcast"} {
        $node_($station) attach [new Agent/Null] 7
        $source set dst_addr_ -1
        $source set dst_port_ 7
    } else {
        $ns_ connect $source $sink
        $ns_ at [expr {0.02 * $station}] "$source send 10"
    }
    return $source
}

# More frames than an otherwise empty channel could take.
proc saturate {source start} {
    global ns_ option
    set flow [new Application/Traffic/CBR]
    $flow set packetSize_ $option(-payload)
    $flow set interval_ [expr {($option(-payload) + 34) * 8 / ($option(-rate) * 1e6)}]
    $flow attach-agent $source
    $ns_ at $start "$flow start"
}

proc count_lines {file pattern since until} {
    set count 0
    seek $file 0
    while {[gets $file line] >= 0} {
        if {[regexp $pattern $line -> time] && $time >= $since && $time < $until} {incr count}
    }
    return $count
}

proc finish {} {
    global option ns_ sink before ready trace since until
    set run [expr {[cpu_s] - $ready}]
    set delivered [expr {[$sink set npkts_] - $before}]
    $ns_ flush-trace
    set attempts [count_lines $trace {^s (\S+) _\d+_ MAC  --- \d+ cbr } $since $until]
    set requests [count_lines $trace {^s (\S+) _\d+_ MAC  --- \d+ RTS } $since $until]
    puts [format {{"peer": "ns2", "mode": "%s", "n": %d, "rate_mbps": %g, "payload": %d,\
        "seconds": %g, "delivered": %d, "attempts": %d, "collisions": %d, "rts": %d,\
        "throughput_share": %.6f, "setup_cpu_s": %.4f, "run_cpu_s": %.4f, "rss_mb": %.1f}} \
        $option(-mode) $option(-n) $option(-rate) $option(-payload) $option(-seconds) $delivered \
        $attempts [expr {max(0, $attempts - $delivered)}] $requests [expr {$delivered * 8e-6 * \
        $option(-payload) / $option(-rate) / $option(-seconds)}] $ready $run [rss_mb]]
    exit 0
}

if {$option(-mode) ni {unicast rts broadcast}} {
    puts stderr "cell.tcl: found -mode $option(-mode); expected unicast, rts or broadcast"
    exit 2
}
Mac/802_11 set dataRate_ $option(-rate)Mb
Mac/802_11 set basicRate_ 1Mb
Mac/802_11 set RTSThreshold_ [expr {$option(-mode) eq "rts" ? 0 : 3000}]

set ns_ [new Simulator]
ns-random $option(-seed)
set trace [file tempfile]
wireless [expr {$option(-n) + 1}] $trace ON OFF
for {set i 0} {$i <= $option(-n)} {incr i} {
    set node_($i) [$ns_ node]
    $node_($i) random-motion 0
    foreach axis {X_ Y_ Z_} place {100 100 0} {$node_($i) set $axis $place}
}
set sink [new Agent/LossMonitor]
$node_($option(-n)) attach $sink 7

set full [expr {0.02 * $option(-n) + 0.5}]
for {set i 0} {$i < $option(-n)} {incr i} {
    saturate [send_to_sink $i] [expr {$full + 0.001 * $i}]
}
set since [expr {$full + 1}]
set until [expr {$since + $option(-seconds)}]
$ns_ at $since {set before [$sink set npkts_]}
$ns_ at $until finish
set ready [cpu_s]
$ns_ run
