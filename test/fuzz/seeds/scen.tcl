# nodes: 3, max x: 100.00, max y: 80.00
$node_(0) set X_ 10.5
$node_(0) set Y_ 20
$node_(0) set Z_ 1.0e+0
$node_(2) set X_ 99.000000000000
$god_ set-dist 0 2 16777215
$ns_ at 0.5 "$node_(0) setdest 30.0 40.0 2.5"
$ns_ at 2.0 "$god_ set-dist 0 2 1"; # a comment
$ns_ at 3.0 "$node_(2) set Y_ 8"
$ns_ at 4.25 "$node_(2) setdest 1 2 0.000000000000 "
$ns_ at 1.25 "$node_(1) setdest 5 5 1"
$node_(1) set X_ 7
