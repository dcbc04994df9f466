# SPDX-License-Identifier: Apache-2.0
# Energy isocontours of the exact and of the recovered parameters with the uniaxial paths on them (the paper's Figure 10):
#   tunica run examples/es_assessment/experiment.json -o results/es
#   echo '{"mu": 10.4, "kappa": 0.27, "k1": 30.6, "k2": 3.94, "theta": 61.3}' > results/x1.json
#   tunica stability examples/es_assessment/experiment.json --model gho --parameters results/x1.json -o results/x1
#   gnuplot -e "results='results/es'; exact='results/x1'" docs/figures/isocontours.gp
set contour base
set cntrparam bspline points 8 order 6
set cntrparam levels discrete 0.5,1,2,4,8,14,20
unset surface
grid(file, run) = sprintf("< awk -F, '$1 == \"%s\" { if ($2 != last) print \"\"; last = $2; print $2, $3, $4 }' %s", run, file)
set datafile separator whitespace
set table $found
splot grid(results.'/energy.csv', 'gho/elitist') using 1:2:3
set table $known
splot grid(exact.'/energy.csv', 'gho') using 1:2:3
unset table
unset contour
set terminal svg size 640,600 font 'DejaVu Sans,13' background rgb 'white'
set output 'docs/figures/isocontours.svg'
set size ratio -1
set xrange [0.75:1.5]
set yrange [0.75:1.5]
set xlabel 'circumferential stretch [-]'
set ylabel 'axial stretch [-]'
set bmargin 7
set key outside bottom center horizontal samplen 3 reverse Left
set border 3
set tics nomirror
set grid lc rgb '#eeeeee'
plot $known using 1:2 with lines lw 5 lc rgb '#bbbbbb' title 'W, exact', \
     $found using 1:2 with lines lw 1.5 dt (6,6) lc rgb '#0072b2' title 'W, recovered', \
     '< grep "^gho/elitist,circ" '.results.'/stability.csv | tr "," " "' using 3:4 with lines lw 2.5 lc rgb '#d55e00' title 'circumferential strip', \
     '< grep "^gho/elitist,axial" '.results.'/stability.csv | tr "," " "' using 4:3 with lines lw 2.5 lc rgb '#009e73' title 'axial strip'
