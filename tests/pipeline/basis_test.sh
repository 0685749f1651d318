#!/usr/bin/env bash
# Round trip through files: what five LEDs shine and the ambient, out of a rendered photograph without contact (8 bits,
# vignetting, without and with noise) and basis images of a sensor file that does not know them.
. "$(dirname "$0")/common.sh"

tiny_sample one
sed -i 's/width_px: 64/width_px: 320/; s/height_px: 48/height_px: 240/; s/^camera:$/&\n  vignetting: {v2: -0.2, v4: 0}/' configs/sensors/mctac.yaml
# Index on the ring, colour, intensity.
leds='1 0.9 0.25 0.1 1.2
3 0.1 1 0.2 0.5
4 0 0.8 0.1 0.4
6 0.05 0.1 1 0.5
7 0.2 0 0.9 0.7'
lit() { awk -v "unknown=$1" '{ printf "      - {index: %d, rgb_linear: [%s], intensity: %s}\n", $1, unknown ? "1, 1, 1" : $2 ", " $3 ", " $4, unknown ? 1 : $5 }' <<<"$leds"; }
sensor() { sed -e '/^      - {index: /d' -e '/^    lit:/r /dev/stdin' configs/sensors/mctac.yaml < <(lit "$1"); }
sensor 0 > configs/sensors/true.yaml
sensor 1 | sed 's/rgb: \[30, 30, 30\]/rgb: [0, 0, 0]/' > configs/sensors/unknown.yaml
render() { # render OUT SENSOR CONFIG
  "$build_dir/bin/render" --config "$3" --sensor "configs/sensors/$2.yaml" --gel one/gels/mctac-tiny/gel.msh --press one/sample/pyramid/press --out "$1"
}
sed 's/^transfer: encoded/transfer: none/' configs/render/default.yaml > plain.yaml
{ cat plain.yaml; echo 'basis_images: true'; } > basis.yaml
render noisy true configs/render/default.yaml
render plain true plain.yaml
render basis unknown basis.yaml
[ ! -e plain/frame_0000/basis_00.exr ] || fail "basis images that nobody asked for"

echo 'intensities: {curve: srgb, shot_gain: 2.0e-4, read_noise: 8.0e-4, block_px: 1}' > intensities.yaml
# Rows of three: the LEDs, then the ambient.
{ awk '{ print $2 * $5, $3 * $5, $4 * $5 }' <<<"$leds"; echo 30 30 30; } > expected
find_again() { # find_again PHOTOGRAPH LED_TOLERANCE AMBIENT_TOLERANCE
  "$build_dir/bin/calibrate" --config intensities.yaml --sensor configs/sensors/unknown.yaml --background "$1/frame_0000/tactile.png" \
    --basis basis/frame_0000/basis_0{0,1,2,3,4}.exr --out "fitted_$1"
  sed -n 's/.*\[\(.*\)\]$/\1/p' "fitted_$1/leds.yaml" | tr -d , > found
  [ "$(wc -l < found)" = 6 ] || fail "there are not five LEDs and an ambient: $(cat "fitted_$1/leds.yaml")"
  paste -d' ' found expected | awk -v "exposure=$(awk '$1 == "exposure:" { print $2; exit }' "$1/render.yaml")" -v "led=$2" -v "ambient=$3" '
    { for (c = 1; c <= 3; ++c) { value = $c / exposure; off = value - $(c + 3); if (off < 0) off = -off
        if (!(off <= (NR < 6 ? led : ambient))) { print "row " NR ", channel " c ": " value ", not " $(c + 3); bad = 1 } } }
    END { exit bad }' || fail "the light of the photograph ($1) is not found again"
}
find_again plain 1e-3 0.3
# Noise of some 1 % of full scale; the ambient is nearly the sum of the LEDs, hence known less well.
find_again noisy 0.01 6
echo "1 passed, 0 failed"
