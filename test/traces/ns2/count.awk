#!/usr/bin/awk -f
# SPDX-License-Identifier: MIT
# Counts a wireless trace of ns-2 by its columns, in any of its three formats: what the tests of
# traces/ns2/ns2_stats.hpp compare with. The faults of the scripts that are handed around are left out: a packet
# is its type and id, as ids repeat; only the first r AGT of a packet at a robot counts; control
# frames, lines of DSR's statistics and of energy are no packets.
function value(key,    i) {
    for (i = 1; i < NF; i++) if ($i == key) return $(i + 1)
    return ""
}
{ sub(/\[energy [^]]*\] /, "") }
$1 !~ /^[srfDd+h]$/ { next }
$2 == "-t" && $4 == "-Hs" {                       # new
    op = $1; t = $3; node = value("-Ni"); layer = value("-Nl"); reason = value("-Nw")
    type = value("-It"); uid = value("-Ii"); size = value("-Il")
    from = value("-Is"); port = from; sub(/.*\./, "", port)
    mac = value("-Mt")
}
$3 == "-s" {                                      # tagged
    op = $1; t = $2; node = $4; layer = value("-k"); reason = "---"
    type = value("-IP:s") == "" ? "" : value("-p"); uid = value("-i"); size = value("-e")
    port = value("-IP:sp"); mac = value("-M:t")
}
$3 ~ /^_/ {                                       # old
    op = $1; t = $2; node = $3; gsub(/_/, "", node); layer = $4; reason = $5
    uid = $6; type = $7; size = $8
    mac = $12; sub(/\]/, "", mac)
    port = ""
    if ($13 == "-------" && $14 ~ /:/) { port = $14; sub(/.*:/, "", port) }
    if (port == "") type = ""
}
op == "+" { op = "s" }
op == "h" { op = "f" }
op == "d" { op = "D" }
op == "D" { drops[layer " " reason]++ }
type == "" { next }
{ packet = type " " uid }
layer == "AGT" && op == "s" && type != "ack" && !(packet in sent) {
    sent[packet] = t; bytes[packet] = size; origin[packet] = node; messages++
    if (messages == 1) first = t
}
layer == "AGT" && op == "r" && (packet in sent) && node != origin[packet] && !((packet, node) in got) {
    got[packet, node] = 1; deliveries++; delay += t - sent[packet]; delivered += bytes[packet]; last = t
}
layer == "RTR" && (op == "s" || op == "f") {
    if (port == 255) { routing++; routed += size } else if (packet in sent) transmissions++
}
END {
    printf "messages %d\ndeliveries %d\ntransmissions %d\n", messages, deliveries, transmissions
    printf "latency_mean_s %.6f\n", deliveries ? delay / deliveries : 0
    printf "routing_packets %d\nrouting_bytes %d\n", routing, routed
    duration = last - first
    printf "throughput_bps %.0f\n", (duration > 0 ? 8 * delivered / duration : 0)
    for (place in drops) printf "drop %s %d\n", place, drops[place] | "sort"
}
