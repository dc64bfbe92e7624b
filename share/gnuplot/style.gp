# The look of all figures of rex; read before the commands of a figure.
# Colours: Okabe and Ito's set, told apart with any kind of colour vision, in an order that also differs in grey.
set encoding utf8
# A line between two points outside of the axes still crosses them.
set clip two
set linetype 1 lc rgb '#0072B2' lw 2 pt 7 ps 0.6
set linetype 2 lc rgb '#D55E00' lw 2 pt 5 ps 0.6
set linetype 3 lc rgb '#009E73' lw 2 pt 9 ps 0.7
set linetype 4 lc rgb '#CC79A7' lw 2 pt 13 ps 0.7
set linetype 5 lc rgb '#56B4E9' lw 2 pt 11 ps 0.7
set linetype 6 lc rgb '#E69F00' lw 2 pt 4 ps 0.6
set linetype 7 lc rgb '#333333' lw 2 pt 6 ps 0.6
set linetype cycle 7
set border 3 lc rgb '#555555' lw 1
set tics nomirror out scale 0.6 textcolor rgb '#333333'
set grid xtics ytics back lt 1 lc rgb '#E3E3E3' lw 0.8
set format '%h'
set key noenhanced top right Left reverse spacing 1.15 samplen 2.5 textcolor rgb '#222222' opaque fillcolor rgb '#38FFFFFF' nobox
set title textcolor rgb '#222222'
set xlabel textcolor rgb '#222222'
set ylabel textcolor rgb '#222222'
set zlabel textcolor rgb '#222222' rotate by 90
set cblabel textcolor rgb '#222222' offset 1,0
# From dark blue over green to pale yellow, lighter with every step, so that it reads in grey, too.
set palette defined (0 '#2D1E5F', 1 '#31508A', 2 '#2B7B8C', 3 '#2FA183', 4 '#77C26B', 5 '#C5D96A', 6 '#F7EFA0')
set colorbox noborder
