# SPDX-License-Identifier: Apache-2.0
# The picture of the README, from a run of the lamb aorta example:
#   gnuplot -e "results='results/lamb-aorta-1'" docs/figures/lamb_aorta.gp
set terminal svg size 860,400 font 'DejaVu Sans,13' background rgb 'white'
set output 'docs/figures/lamb_aorta.svg'
set datafile separator ','
set multiplot layout 1,2 margins 0.08,0.98,0.15,0.90 spacing 0.09
set yrange [0:]
set key top left reverse Left samplen 2
set xlabel 'stretch [-]'
set grid lc rgb '#dddddd'
set border 3
set tics nomirror
own(run) = strcol(1) eq run ? 1 : NaN
do for [strip in 'circumferential axial'] {
  set title strip.' strip' font ',14'
  set ylabel strip eq 'circumferential' ? 'Cauchy stress [kPa]' : ''
  file = results.'/fit_'.strip.'_strip.csv'
  plot file using (own('gho/lm')*$2):3 every ::1 with points pt 7 ps 0.5 lc rgb '#666666' title 'measured (Rivera et al. 2021)', \
       file using (own('gho/lm')*$2):4 every ::1 with lines lw 2.5 lc rgb '#0072b2' title 'gho', \
       file using (own('holzapfel_2015/es')*$2):4 every ::1 with lines lw 2 dt (8,8) lc rgb '#d55e00' title 'holzapfel 2015'
}
unset multiplot
