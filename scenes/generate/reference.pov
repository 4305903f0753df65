// scenes/reference.txt for POV-Ray, for timing side by side:
//   povray +Ireference.pov +Oreference.png +W800 +H600 -D -A        1 ray a pixel
//   povray +Ireference.pov +Oreference.png +W800 +H600 -D +A0.0 +R4 16 rays a pixel
// The two differ where POV-Ray has no equal: its phong highlight is grey, so that the specular colour
// 0.8 0.8 1 is its mean, and light fades by 2 / (1 + (d / fade_distance)^2), which with a small
// fade_distance is 1 / d^2 to about one part in a million.
#version 3.7;
global_settings { assumed_gamma 1.0  max_trace_level 6  ambient_light rgb 0 }

// POV-Ray is left-handed: `right` points to -x. 51.7733 degrees across is 40 degrees down at 4:3.
camera {
  location <0, 1, 2.5>
  sky y
  up y
  right -x * 800 / 600
  angle 2 * degrees(atan(tan(radians(20)) * 800 / 600))
  look_at <0, -0.1, -5>
}

#declare Fade = 0.005;
#macro Light(Position)
  light_source { Position color rgb 20 / (2 * Fade * Fade) fade_distance Fade fade_power 2 }
#end
Light(<-5, 6, 2>)
Light(<5, 6, 0>)
Light(<0, 7, -4>)
Light(<-1, 4, 4>)

sphere { <-2.2, 0, -4>, 1
  pigment { color rgb <0.7, 0.08, 0.08> }
  finish { ambient 0 diffuse 1 phong 0.867 phong_size 50 reflection { 0.25 } }
}
sphere { <-1.1, -0.3, -8>, 0.7
  pigment { color rgb <0.7, 0.35, 0.47> }
  finish { ambient 0 diffuse 1 phong 0.867 phong_size 30 reflection { 0.25 } }
}

box { -0.6, 0.6
  rotate <0, 45, 0>
  rotate <35.26, 0, 0>
  translate <2.2, 0, -5>
  pigment { color rgb <0.15, 0.25, 0.8> }
  finish { ambient 0 diffuse 1 phong 0.867 phong_size 50 reflection { 0.1 } }
}

// The faces of a b c d are abc, abd, acd, bcd; u and v run to the second and third corner.
#declare A = <0.6157903, 1.3003388, -5.2041672>;
#declare B = <0.7273009, 0.2600487, -6.1344155>;
#declare C = <-0.5341610, 0.7641077, -5.7958328>;
#declare D = <0.1910698, 0.0100000, -4.8655845>;
mesh {
  triangle { A, B, C uv_vectors <0, 0>, <1, 0>, <0, 1> }
  triangle { A, B, D uv_vectors <0, 0>, <1, 0>, <0, 1> }
  triangle { A, C, D uv_vectors <0, 0>, <1, 0>, <0, 1> }
  triangle { B, C, D uv_vectors <0, 0>, <1, 0>, <0, 1> }
  inside_vector y
  texture {
    uv_mapping
    pigment { checker color rgb <0.1, 0.7, 0.2>, color rgb <0.85, 0.95, 0.85> scale 1 / 5 }
    finish { ambient 0 diffuse 1 phong 0.8 phong_size 30 }
  }
}

// In clrt v grows towards -z. POV-Ray's checker is one of space: the plane cuts it in the middle of a layer.
plane { y, -1
  pigment { checker color rgb 0.65, color rgb 0.04 translate -1.5 * y scale <1, 1, -1> }
  finish { ambient 0 diffuse 1 reflection { 0.3 } }
}
