// A brake pad on its backing plate, with a slot across the middle of the lining: lengths in m.
//   python3 make.py, or gmsh -3 -format msh41 brake-pad.geo -o brake-pad.msh
// The lining slides along x on a disc below it; the plate is pressed down from above.
length = 0.08; depth = 0.04; lining = 0.010; plate = 0.005; slot = 0.006; slotDepth = 0.006;
SetFactory("OpenCASCADE");
Box(1) = {-length / 2, 0, 0, length, lining, depth};
Box(2) = {-slot / 2, 0, 0, slot, slotDepth, depth};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Box(4) = {-length / 2, lining, 0, length, plate, depth};
BooleanFragments{ Volume{3, 4}; Delete; }{}

e = 1e-6;
Physical Volume("lining") = Volume In BoundingBox{-length, -e, -e, length, lining + e, depth + e};
Physical Volume("plate") = Volume In BoundingBox{-length, lining - e, -e, length, lining + plate + e, depth + e};
Physical Surface("disc") = Surface In BoundingBox{-length, -e, -e, length, e, depth + e};
Physical Surface("back") = Surface In BoundingBox{-length, lining + plate - e, -e, length, lining + plate + e, depth + e};
Physical Surface("symmetry") = Surface In BoundingBox{-length, -e, -e, length, lining + plate + e, e};
Physical Surface("leading") = Surface In BoundingBox{-length / 2 - e, lining - e, -e, -length / 2 + e, lining + plate + e, depth + e};

Mesh.MeshSizeMin = 0.0055;
Mesh.MeshSizeMax = 0.0055;
