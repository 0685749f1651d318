#include "common/base/error.h"
#include "stages/image/calibrate/modes.h"

namespace {

using namespace tacipc;

const StageSpec kCalibrate{
    .name = "calibrate",
    .summary = "Fit the light of a sensor, or its whole file, to photographs without and with contact of a ball.",
    .inputs = {{.flag = "--config", .help = "ball, lamps, fit; or sensor_fit (YAML)"},
               {.flag = "--sensor", .help = "the sensor: camera, for sensor_fit all (YAML)"},
               {.flag = "--background", .help = "photograph without contact (PNG)"},
               {.flag = "--basis",
                .help = "image of each LED or group alone (EXR, R G B): fits colours of known LEDs",
                .required = false,
                .many = true},
               {.flag = "--photographs", .help = "folder of the photographs of balls", .required = false},
               {.flag = "--labels", .help = "lines `image.png (x, y) radius`, pixels", .required = false},
               {.flag = "--press", .help = "folder of a press of the ball, with increasing depth", .required = false},
               {.flag = "--gel", .help = "gel.msh of that press", .required = false},
               {.flag = "--objects",
                .help = "known objects that calibrate too: photographs, places (YAML)",
                .required = false},
               {.flag = "--object-press",
                .help = "folder of a press of such an object in the same gel",
                .required = false,
                .many = true,
                .named = true},
               {.flag = "--shapes",
                .help = "indentation maps (EXR), one per label, then one per object, in place of presses (with "
                        "--rival: of the rigid objects alone)",
                .required = false,
                .many = true},
               {.flag = "--rival",
                .help = "another simulator's light, to be fitted in place of ours (YAML)",
                .required = false},
               {.flag = "--balls",
                .help = "balls.csv of calibrate: contacts as fitted, in place of the labels' circles (with --rival)",
                .required = false}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kCalibrate, argc, argv, [](Stage& stage) {
    const bool whole_sensor = ConfigReader::from_file(stage.input("--config")).has("sensor_fit");
    const bool rival = stage.optional_input("--rival").has_value();
    if (stage.optional_input("--balls") && !rival) throw UsageError("--balls: is for --rival alone");
    if (rival && (whole_sensor || !stage.inputs("--basis").empty()))
      throw UsageError("--rival: is fitted to balls, without --basis or sensor_fit");
    if (rival)
      calibrate_rival(stage);
    else if (whole_sensor)
      calibrate_sensor(stage);
    else if (stage.inputs("--basis").empty())
      calibrate_balls(stage);
    else
      calibrate_leds(stage);
  });
}
