# shellcheck shell=bash
# Shared by the tests against photographs: settings of a small benchmark in configs/studies/sim2real/made, and below truth/ what makes
# its photographs: gel, press of a ball, light of two lamps, background.
export OPENBLAS_NUM_THREADS=1
bin=${build_dir:?}/bin
sed -i 's/width_px: 320/width_px: 100/; s/height_px: 240/height_px: 75/' configs/sensors/gelsight_mini.yaml

made_settings() { # what every benchmark of these tests has
  cat <<'END'
sensor: ../../sensors/gelsight_mini.yaml
mesh: made/mesh.yaml
press: made/press.yaml
calibrate: made/calibrate.yaml
baseline: ../../rivals/baseline/height_map.yaml
calibration_ball: {radius_mm: 3.0, deepest_mm: 1.0, steps: 5}
ball_edge_mm: 0.5
mesh_spacing_mm: 0.1
END
}

make_truth() {
mkdir configs/studies/sim2real/made
sed 's/centre_mm: 0.18/centre_mm: 0.35/; s/inner_mm: 0.3/inner_mm: 0.6/' configs/studies/sim2real/gsmini_balls/mesh.yaml > configs/studies/sim2real/made/mesh.yaml
cp configs/studies/sim2real/gsmini_balls/press.yaml configs/studies/sim2real/made/press.yaml
cat > configs/studies/sim2real/made/calibrate.yaml <<'END'
ball_radius_mm: 3.0
contact_gap_mm: 0.02
fit_contact_gap: true
label_sigma_px: 2.0
fit_radius_px: 24
fit_stride_px: 1
drift_radius_px: 40
lamps:
  - {azimuth_deg: 265, distance_mm: 16, elevation_tan: 0.5}
  - {azimuth_deg: 10, distance_mm: 20, elevation_tan: 0.6}
lamp_bounds: {azimuth_deg: 25, elevation_tan: [0.2, 0.9], distance_mm: [11, 40]}
environment_degree: 1
shadow_softness: 0.15
blur_px: 0
ridge: 1.0e-6
folds: 5
END

"$bin"/tetmesh --sensor configs/sensors/gelsight_mini.yaml --config configs/studies/sim2real/made/mesh.yaml --out truth/gel
echo 'ball: {radius_mm: 3.0, edge_mm: 0.5}' > truth/indenter.yaml
"$bin"/indenter --config truth/indenter.yaml --out truth/ball
echo 'motion: {kind: press, depth_mm: 1.0, steps: 5}' > truth/motion.yaml
"$bin"/press --name ball --object truth/ball/object.ply --object-config configs/objects/embossed.yaml --gel truth/gel/gel.msh \
  --sensor configs/sensors/gelsight_mini.yaml --config configs/studies/sim2real/made/press.yaml --sample truth/motion.yaml --out truth/press
cat > truth/light.yaml <<'END'
light_field:
  field_half_width_mm: 10.145
  shadow_softness: 0.15
  blur_px: 0
  lamps:
    - position_mm: [0, -14, -7.7]
      linear_codes: {red: [70, 5, -10], green: [-10, 0, 0], blue: [-8, 0, 0]}
      quadratic_codes: {red: [0, 0, 0], green: [0, 0, 0], blue: [0, 0, 0]}
    - position_mm: [17, 0, -9]
      linear_codes: {red: [-12, 0, 0], green: [50, 10, 0], blue: [60, 0, 5]}
      quadratic_codes: {red: [0, 0, 0], green: [0, 0, 0], blue: [0, 0, 0]}
END
python3 - truth/background.png <<'END'
import struct, sys, zlib
def chunk(kind, data): return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
rows = b"".join(b"\0" + bytes(c for x in range(100) for c in (90 + x // 4, 110 - y // 3, 95 + (7 * x + 13 * y) % 5)) for y in range(75))
with open(sys.argv[1], "wb") as png:
    png.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 100, 75, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
END
echo 'contact_gap_mm: 0.06' > truth/contact.yaml
mkdir -p shared/shots/images
}

shade_truth() { # shade_truth CONFIG OUT [FLAG …]
  "$bin"/shade --config "$1" --out "$2" --sensor configs/sensors/gelsight_mini.yaml --light truth/light.yaml --background truth/background.png \
    --press truth/press --gel truth/gel/gel.msh "${@:3}"
}
