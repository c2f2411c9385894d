set encoding utf8
set terminal svg size 640,340 dynamic font 'Helvetica,15' noenhanced rounded
set border 3 lw 0.8 lc rgb '#8796a5'
set tics nomirror out scale 0.5 textcolor rgb '#51606e'
set grid lw 0.6 lt 1 lc rgb '#e3e8ed'
set key top right horizontal textcolor rgb '#24313d' samplen 1.6 outside center above
set style line 1 lc rgb '#8796a5'

set output 'body_capsule_fy.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'Vertical load / (kN/m)' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-2.456431:15.67046]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
set label '13.57 kN/m at 0.1385 s' at 0.1384704,13.57313 point pt 7 ps 0.5 lc rgb '#24313d' offset 0.8,0.4 textcolor rgb '#24313d'
plot 'body_capsule_fy.dat' index 0 using 1:2  with lines lw 1.8 lc rgb '#0f2f4f' title 'total', \
  'body_capsule_fy.dat' index 1 using 1:2  with lines lw 1.1 lc rgb '#2f7fc1' title 'physical', \
  'body_capsule_fy.dat' index 2 using 1:2  with lines lw 1.1 lc rgb '#d1495b' title 'repair'

set output 'body_capsule_fx.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'Load along x / (kN/m)' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-1.942666:0.9175913]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
set label '−1.777 kN/m at 0.1410 s' at 0.1410118,-1.777196 point pt 7 ps 0.5 lc rgb '#24313d' offset 0.8,0.4 textcolor rgb '#24313d'
plot 'body_capsule_fx.dat' index 0 using 1:2  with lines lw 1.8 lc rgb '#0f2f4f' title 'total', \
  'body_capsule_fx.dat' index 1 using 1:2  with lines lw 1.1 lc rgb '#2f7fc1' title 'physical', \
  'body_capsule_fx.dat' index 2 using 1:2  with lines lw 1.1 lc rgb '#d1495b' title 'repair'

set output 'body_capsule_velocity.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'velocity / (m/s)' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-4.68913:1.373646]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'body_capsule_velocity.dat' index 0 using 1:2  with lines lw 1.6 lc rgb '#0f2f4f' title 'v_x', \
  'body_capsule_velocity.dat' index 1 using 1:2  with lines lw 1.6 lc rgb '#d1495b' title 'v_y'

set output 'body_capsule_acceleration.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'acceleration / g' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-7.759946:39.14773]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'body_capsule_acceleration.dat' index 0 using 1:2  with lines lw 1.6 lc rgb '#0f2f4f' title 'a_x', \
  'body_capsule_acceleration.dat' index 1 using 1:2  with lines lw 1.6 lc rgb '#d1495b' title 'a_y'

set output 'body_capsule_displacement.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'displacement / m' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-0.9268469:0.4790227]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'body_capsule_displacement.dat' index 0 using 1:2  with lines lw 1.6 lc rgb '#0f2f4f' title 'x', \
  'body_capsule_displacement.dat' index 1 using 1:2  with lines lw 1.6 lc rgb '#d1495b' title 'y'

set output 'body_capsule_mz.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'Moment / (kN m/m)' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-2.440561:1.155241]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
set label '−2.233 kN m/m at 0.1385 s' at 0.1384704,-2.23254 point pt 7 ps 0.5 lc rgb '#24313d' offset 0.8,0.4 textcolor rgb '#24313d'
plot 'body_capsule_mz.dat' index 0 using 1:2  with lines lw 1.8 lc rgb '#0f2f4f' title 'total', \
  'body_capsule_mz.dat' index 1 using 1:2  with lines lw 1.1 lc rgb '#2f7fc1' title 'physical', \
  'body_capsule_mz.dat' index 2 using 1:2  with lines lw 1.1 lc rgb '#d1495b' title 'repair'

set output 'body_capsule_attitude.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'angle / deg' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-1.984199:13.2253]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'body_capsule_attitude.dat' index 0 using 1:2  with lines lw 1.6 lc rgb '#d1495b' title 'pitch'

set output 'body_capsule_wetted.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'wetted length / m' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-0.06871426:1.050347]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'body_capsule_wetted.dat' index 0 using 1:2  with lines lw 1.6 lc rgb '#0f2f4f' title 'wetted'

set output 'body_capsule_submergence.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'submergence / m' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-0.5542579:0.4128805]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'body_capsule_submergence.dat' index 0 using 1:2  with lines lw 1.6 lc rgb '#0f2f4f' title 'lowest point'

set output 'probe_0.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'aside / m' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-0.1492349:0.1921355]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'probe_0.dat' index 0 using 1:2  with lines lw 1.4 lc rgb '#0f2f4f' notitle

set output 'probe_1.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'aside.undisturbed' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-0.1460119:0.1415057]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'probe_1.dat' index 0 using 1:2  with lines lw 1.4 lc rgb '#0f2f4f' notitle

set output 'probe_2.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'seat.ax / (m/s²)' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-48.25144:55.5355]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'probe_2.dat' index 0 using 1:2  with lines lw 1.4 lc rgb '#0f2f4f' notitle

set output 'probe_3.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'seat.ay / (m/s²)' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-109.8377:332.6677]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'probe_3.dat' index 0 using 1:2  with lines lw 1.4 lc rgb '#0f2f4f' notitle

set output 'volume.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'change of volume / %' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-0.05137608:0.02678285]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'volume.dat' index 0 using 1:2  with lines lw 1.8 lc rgb '#0f2f4f' title 'total', \
  'volume.dat' index 1 using 1:2  with lines lw 1.1 lc rgb '#2f7fc1' title 'time steps', \
  'volume.dat' index 2 using 1:2  with lines lw 1.1 lc rgb '#3a9d7c' title 'created', \
  'volume.dat' index 3 using 1:2  with lines lw 1.1 lc rgb '#d1495b' title 'deleted', \
  'volume.dat' index 4 using 1:2  with lines lw 1.1 lc rgb '#d98e04' title 'returned'

set output 'energy.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'energy since the start / (J/m)' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-534.9047:187.5105]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'energy.dat' index 0 using 1:2  with lines lw 1.4 lc rgb '#2f7fc1' title 'kinetic', \
  'energy.dat' index 1 using 1:2  with lines lw 1.4 lc rgb '#3a9d7c' title 'potential', \
  'energy.dat' index 2 using 1:2  with lines lw 1.4 lc rgb '#d98e04' title 'work on walls', \
  'energy.dat' index 3 using 1:2  with lines lw 1.1 lc rgb '#d1495b' title 'repairs', \
  'energy.dat' index 4 using 1:2  with lines lw 1.8 lc rgb '#0f2f4f' title 'balance'

set output 'energy_gain.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'energy gain / %' textcolor rgb '#51606e'
set ytics autofreq
set yrange [-30.8565:7.345752]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'energy_gain.dat' index 0 using 1:2  with lines lw 1.8 lc rgb '#0f2f4f' title 'gain', \
  'energy_gain.dat' index 1 using 1:2  with lines lw 1.1 lc rgb '#d1495b' title '5 %: unphysical', \
  'energy_gain.dat' index 2 using 1:2  with lines lw 1.1 lc rgb '#d98e04' title '2 %: doubtful'

set output 'step.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'passes a step' textcolor rgb '#51606e'
set ytics autofreq
set yrange [0:1.1]
set ytics 1
set border 11
set y2tics
set y2label 'dt / ms' textcolor rgb '#51606e'
set y2range [-0.9983446:17.07344]
unset label
unset arrow
set xzeroaxis lt 1 lw 0.8 lc rgb '#8796a5'
plot 'step.dat' index 0 using 1:2  with steps lw 1.2 lc rgb '#d98e04' title 'passes', \
  'step.dat' index 1 using 1:2 axes x1y2 with lines lw 1.4 lc rgb '#0f2f4f' title 'dt'

set output 'mesh.svg'
set xlabel 't / s' textcolor rgb '#51606e'
set ylabel 'nodes, elements' textcolor rgb '#51606e'
set ytics autofreq
set yrange [845.66:4450.34]
set border 3
unset y2tics
unset y2label
unset label
unset arrow
unset xzeroaxis
plot 'mesh.dat' index 0 using 1:2  with lines lw 1.6 lc rgb '#0f2f4f' title 'nodes', \
  'mesh.dat' index 1 using 1:2  with lines lw 1.6 lc rgb '#2f7fc1' title 'elements'
