reset
set encoding utf8
set terminal svg size 1000,751 dynamic font 'Helvetica,19' noenhanced
set lmargin screen 0.095
set rmargin screen 0.855
set tmargin screen 0.973369
set bmargin screen 0.113182
set border 15 lw 0.8 lc rgb '#8796a5'
set tics out scale 0.4 nomirror textcolor rgb '#51606e'
set xlabel 'both axes in m' textcolor rgb '#51606e' offset 0,0.3
set key off
set colorbox user origin 0.872,0.113182 size 0.022,0.860186
set format cb '%.4g'
set palette defined (0 '#dcecf5', 0.12 '#a9d3ea', 0.3 '#5fa8d8', 0.5 '#3272b4', 0.68 '#3f3f97', 0.84 '#7a2a86', 1 '#c2185b')
set output 'field_0.svg'
set xrange [-0.951360152:1.34250984]
set yrange [-0.599078235:1.35071126]
set cbrange [0:6.46899]
set cblabel 'pressure / kPa, 0 and less' offset 0.6,0 textcolor rgb '#51606e'
plot NaN with lines lc palette notitle
reset
set encoding utf8
set terminal svg size 1000,751 dynamic font 'Helvetica,19' noenhanced
set lmargin screen 0.095
set rmargin screen 0.855
set tmargin screen 0.973369
set bmargin screen 0.113182
set border 15 lw 0.8 lc rgb '#8796a5'
set tics out scale 0.4 nomirror textcolor rgb '#51606e'
set xlabel 'both axes in m' textcolor rgb '#51606e' offset 0,0.3
set key off
set colorbox user origin 0.872,0.113182 size 0.022,0.860186
set format cb '%.4g'
set palette defined (0 '#dcecf5', 0.12 '#a9d3ea', 0.3 '#5fa8d8', 0.5 '#3272b4', 0.68 '#3f3f97', 0.84 '#7a2a86', 1 '#c2185b')
set output 'field_1.svg'
set xrange [-0.951360152:1.34250984]
set yrange [-0.599078235:1.35071126]
set cbrange [0:27.2686]
set cblabel 'pressure / kPa, 27.3 and more, 0 and less' offset 0.6,0 textcolor rgb '#51606e'
plot NaN with lines lc palette notitle
reset
set encoding utf8
set terminal svg size 1000,751 dynamic font 'Helvetica,19' noenhanced
set lmargin screen 0.095
set rmargin screen 0.855
set tmargin screen 0.973369
set bmargin screen 0.113182
set border 15 lw 0.8 lc rgb '#8796a5'
set tics out scale 0.4 nomirror textcolor rgb '#51606e'
set xlabel 'both axes in m' textcolor rgb '#51606e' offset 0,0.3
set key off
set colorbox user origin 0.872,0.113182 size 0.022,0.860186
set format cb '%.4g'
set palette defined (0 '#dcecf5', 0.12 '#a9d3ea', 0.3 '#5fa8d8', 0.5 '#3272b4', 0.68 '#3f3f97', 0.84 '#7a2a86', 1 '#c2185b')
set output 'field_2.svg'
set xrange [-0.951360152:1.34250984]
set yrange [-0.599078235:1.35071126]
set cbrange [0:6.45607]
set cblabel 'pressure / kPa' offset 0.6,0 textcolor rgb '#51606e'
plot NaN with lines lc palette notitle
