# SPDX-License-Identifier: MIT
# What flood.tcl and cell.tcl share: options, radios, and what this process has used.

# Replaces the defaults in the array by what the command line says.
proc read_options {options arguments} {
    upvar $options option
    foreach {name value} $arguments {
        if {![info exists option($name)]} {
            puts stderr "unknown option $name; expected one of [lsort [array names option]]"
            exit 2
        }
        set option($name) $value
    }
}

# From now on a node has an 802.11 radio and a routing agent that only hands packets on. The trace
# channel gets the lines of MACs and agents that are ON.
proc wireless {nodes trace macs agents} {
    global ns_
    $ns_ trace-all $trace
    set field [new Topography]
    $field load_flatgrid 100000 100000
    create-god $nodes
    $ns_ node-config -adhocRouting DumbAgent -llType LL -macType Mac/802_11 \
        -ifqType Queue/DropTail/PriQueue -ifqLen 50 -antType Antenna/OmniAntenna \
        -propType Propagation/TwoRayGround -phyType Phy/WirelessPhy \
        -channel [new Channel/WirelessChannel] -topoInstance $field \
        -agentTrace $agents -macTrace $macs -routerTrace OFF -movementTrace OFF
}

proc first_field {file pattern} {
    set channel [open $file]
    regexp $pattern [read $channel] -> value
    close $channel
    return $value
}

# User and system time of this process [s].
proc cpu_s {} {
    return [expr {[first_field /proc/self/schedstat {^(\d+)}] * 1e-9}]
}

# Largest resident set [MiB].
proc rss_mb {} {
    return [expr {[first_field /proc/self/status {VmHWM:\s+(\d+)}] / 1024.0}]
}
