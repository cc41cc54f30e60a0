// A hub pressed onto a tapered shaft, a quarter of its section: lengths in m.
//   python3 make.py, or gmsh -2 -format msh22 press-fit.geo -o press-fit.msh
// The shaft is rigid and lies inside the hub; the hub is split into a bush (inner) and a rim (outer).
inner = 0.020; middle = 0.026; outer = 0.040; around = 24; through = 4; beyond = 6;
Point(1) = {0, 0, 0};
For i In {0 : 2}
  radius = (i == 0) ? inner : (i == 1) ? middle : outer;
  Point(10 + i) = {radius, 0, 0};
  Point(20 + i) = {0, radius, 0};
  Circle(i + 1) = {10 + i, 1, 20 + i};
EndFor
Line(11) = {10, 11};
Line(12) = {11, 12};
Line(21) = {20, 21};
Line(22) = {21, 22};
Curve Loop(1) = {11, 2, -21, -1};
Curve Loop(2) = {12, 3, -22, -2};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve {1, 2, 3} = around + 1;
Transfinite Curve {11, 21} = through + 1;
Transfinite Curve {12, 22} = beyond + 1;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};

Physical Surface("bush") = {1};
Physical Surface("rim") = {2};
Physical Curve("bore") = {1};
Physical Curve("mantle") = {3};
Physical Curve("along-x") = {11, 12};
Physical Curve("along-y") = {21, 22};
