// The commands as scripts call them.
#include "common/command/file_commands.h"

#include <fmt/core.h>

#include "tests/program_test.h"

namespace tacipc {
namespace file_commands_test {

class FileCommands : public ProgramTest {
 protected:
  /// Exit code of `tacipc …` in the scratch folder; what it printed is in printed_.
  int tacipc(const std::string& arguments) {
    const std::string printed = (scratch_ / "printed.txt").string();
    const int code = run_command(fmt::format("cd '{}' && {{ {}/tacipc {}; }} > '{}'", (scratch_ / "").string(),
                                             TACIPC_BIN_DIR, arguments, printed));
    printed_ = read_file(printed);
    return code;
  }

  std::string printed_;
};

using GetCommand = FileCommands;
using SetCommand = FileCommands;
using TableCommand = FileCommands;
using PathsCommand = FileCommands;
using UnchangedCommand = FileCommands;

const char* const kRecord =
    "stage: press\noutputs:\n  frame_0001/x.png: ab12\n  log.txt: cd\nsummary:\n  frames: 6\n  force_n: [0.5, 1.25]\n"
    "  phases:\n    - {kind: press, steps: 5}\n    - {kind: hold, steps: 2}\n  \"title\": \"a: b\"\n";

TEST_F(GetCommand, PrintsALineForEachValue) {
  scratch_.file("r.yaml", kRecord);
  EXPECT_EQ(tacipc("get r.yaml summary.frames summary.force_n summary.phases[1].steps summary.title stage"), 0);
  EXPECT_EQ(printed_, "6\n0.5\n1.25\n2\na: b\npress\n");
  EXPECT_EQ(tacipc("get r.yaml outputs.frame_0001/x.png"), 0);
  EXPECT_EQ(printed_, "ab12\n");
  EXPECT_EQ(tacipc("get r.yaml summary.phases[0]"), 0);
  EXPECT_EQ(printed_, "kind: press\nsteps: 5\n");
  EXPECT_EQ(tacipc("get r.yaml outputs --keys"), 0);
  EXPECT_EQ(printed_, "frame_0001/x.png\nlog.txt\n");
  EXPECT_EQ(said_, "");
}

TEST_F(GetCommand, PrintsARowForEachMapOfAList) {
  scratch_.file("r.yaml", kRecord);
  EXPECT_EQ(tacipc("get r.yaml summary.phases --fields steps,kind"), 0);
  EXPECT_EQ(printed_, "5\tpress\n2\thold\n");
  EXPECT_EQ(tacipc("get r.yaml summary.phases --fields kind,depth"), 1);
  EXPECT_EQ(said_, "tacipc get: error: r.yaml: summary.phases[0]: has no single value depth\n");
  EXPECT_EQ(tacipc("get r.yaml summary.phases --fields kind,depth --default -"), 0);
  EXPECT_EQ(printed_, "press\t-\nhold\t-\n");
  EXPECT_EQ(tacipc("get r.yaml summary --fields kind"), 1);
  EXPECT_EQ(said_, "tacipc get: error: r.yaml: summary: is not a list\n");
}

TEST_F(UnchangedCommand, SaysItByItsCode) {
  scratch_.file("mesh.txt", "mesh");
  scratch_.file("out/copy.txt", "mesh");
  scratch_.file(
      "out/copy.yaml",
      fmt::format("stage: copy\ninputs:\n  mesh:\n    path: ../mesh.txt\n    hash: {}\noutputs:\n  copy.txt: ab\n",
                  content_hash(scratch_ / "mesh.txt")));
  EXPECT_EQ(tacipc("unchanged out/copy.yaml"), 0);
  scratch_.file("mesh.txt", "another");
  EXPECT_EQ(tacipc("unchanged out/copy.yaml"), 1);
  EXPECT_EQ(tacipc("unchanged out/none.yaml"), 1);
  scratch_.file("out/bad.yaml", "stage: [");
  EXPECT_EQ(tacipc("unchanged out/bad.yaml"), 1);
  EXPECT_EQ(said_, "");
  EXPECT_EQ(tacipc("unchanged"), 2);
}

TEST_F(PathsCommand, PrintsWhereTheFilesOfAMotionLie) {
  scratch_.file("m/one.yaml", "motion: {kind: path, file: a.csv}  # file: no.csv\n");
  scratch_.file("m/more.yaml",
                "motion:\n  - {kind: press, depth_mm: 1}\n  - kind: path\n    \"file\": ../b c.csv\n  - {kind: path, "
                "file: '/d.csv'}\n");
  EXPECT_EQ(tacipc("paths m/one.yaml"), 0);
  EXPECT_EQ(printed_, "m/a.csv\n");
  EXPECT_EQ(tacipc("paths m/more.yaml"), 0);
  EXPECT_EQ(printed_, "m/../b c.csv\n/d.csv\n");
  scratch_.file("m/none.yaml", "placement: {rotate_deg: 1}\n");
  EXPECT_EQ(tacipc("paths m/none.yaml"), 0);
  EXPECT_EQ(printed_, "");
  EXPECT_EQ(tacipc("paths m/gone.yaml"), 1);
  EXPECT_EQ(said_, "tacipc paths: error: m/gone.yaml: cannot be read: No such file or directory\n");
}

TEST_F(GetCommand, SaysWhatIsNotThere) {
  scratch_.file("r.yaml", kRecord);
  EXPECT_EQ(tacipc("get r.yaml stage summary.frame"), 1);
  EXPECT_EQ(printed_, "");
  EXPECT_EQ(said_, "tacipc get: error: r.yaml: summary.frame: there is no such key (did you mean frames?)\n");
  EXPECT_EQ(tacipc("get none.yaml stage"), 1);
  EXPECT_EQ(said_, "tacipc get: error: none.yaml: cannot be read: No such file or directory\n");
  EXPECT_EQ(tacipc("get r.yaml summary.phases"), 1);
  EXPECT_EQ(said_,
            "tacipc get: error: r.yaml: summary.phases: is not a list of single values; ask for a part, such as [0]\n");
  EXPECT_EQ(tacipc("get r.yaml stage --keys"), 1);
  EXPECT_EQ(said_, "tacipc get: error: r.yaml: stage: has no keys\n");
  EXPECT_EQ(tacipc("get r.yaml"), 2);
  EXPECT_EQ(said_, "tacipc get: error: key is required (see tacipc get --help)\n");
  scratch_.file("r.yaml", "a: 1\nb: [\n");
  EXPECT_EQ(tacipc("get r.yaml a"), 2);
  EXPECT_EQ(said_, "r.yaml:3:1: not valid YAML: end of sequence flow not found\n");
}

TEST_F(GetCommand, GivesTheDefaultForWhatIsNotThere) {
  scratch_.file("r.yaml", kRecord);
  EXPECT_EQ(tacipc("get r.yaml summary.x stage --default none"), 0);
  EXPECT_EQ(printed_, "none\npress\n");
  EXPECT_EQ(tacipc("get none.yaml summary.x --default ''"), 0);
  EXPECT_EQ(printed_, "\n");
  EXPECT_EQ(said_, "");
  scratch_.file("r.yaml", "a: [\n");  // what is there but cannot be read is no matter of a default
  EXPECT_EQ(tacipc("get r.yaml a --default none"), 2);
}

TEST_F(SetCommand, PrintsTheChangedFileOrNothing) {
  scratch_.file("c.yaml", "gel: 1  # one\nsensor: {width: 2}\nmotion: 3\n");
  EXPECT_EQ(tacipc("set c.yaml gel=5 '+sensor.y=[1, 2]' -motion"), 0);
  EXPECT_EQ(printed_, "gel: 5  # one\nsensor: {width: 2, y: [1, 2]}\n");
  EXPECT_EQ(tacipc("set c.yaml"), 0);
  EXPECT_EQ(printed_, "gel: 1  # one\nsensor: {width: 2}\nmotion: 3\n");
  EXPECT_EQ(tacipc("set c.yaml gel=5 sensor.height=1 +gel=2 -sensor.with friction=e=f"), 2);
  EXPECT_EQ(printed_, "");
  EXPECT_EQ(said_,
            "c.yaml:2:1: sensor.height: there is no such key\nc.yaml:1:1: gel: exists already\n"
            "c.yaml:2:1: sensor.with: there is no such key (did you mean width?)\n"
            "c.yaml:1:1: friction: there is no such key\n");
  for (const std::string change : {"a", "+a", "=1", "-"}) {
    EXPECT_EQ(tacipc("set c.yaml " + change), 2);
    EXPECT_EQ(said_, "tacipc set: error: '" + change + "': say KEY=VALUE, +KEY=VALUE or -KEY\n");
  }
  EXPECT_EQ(tacipc("set none.yaml a=1"), 1);
  EXPECT_EQ(said_, "tacipc set: error: none.yaml: cannot be read: No such file or directory\n");
}

TEST_F(TableCommand, PrintsColumnsOfTheRowsThatFit) {
  scratch_.file("t.csv", "id,split,note\na,train,\"x, y\"\nb,test,\"say \"\"no\"\"\"\nc,train,\"two\nlines\"\n");
  EXPECT_EQ(tacipc("table t.csv"), 0);
  EXPECT_EQ(printed_, "a\ttrain\tx, y\nb\ttest\tsay \"no\"\nc\ttrain\ttwo lines\n");
  EXPECT_EQ(tacipc("table t.csv --columns note,id --where split=train"), 0);
  EXPECT_EQ(printed_, "x, y\ta\ntwo lines\tc\n");
  EXPECT_EQ(tacipc("table t.csv --where split=train --where id=c --count"), 0);
  EXPECT_EQ(printed_, "1\n");
  EXPECT_EQ(tacipc("table t.csv --where split=none"), 0);
  EXPECT_EQ(printed_, "");
}

TEST_F(TableCommand, SaysWhichColumnsThereAre) {
  scratch_.file("t.csv", "id,split\na,train\nb\n");
  EXPECT_EQ(tacipc("table t.csv --columns id,spilt"), 1);
  EXPECT_EQ(said_, "tacipc table: error: t.csv: there is no column 'spilt'; it has id, split\n");
  EXPECT_EQ(tacipc("table t.csv --where x=1"), 1);
  EXPECT_EQ(said_, "tacipc table: error: t.csv: there is no column 'x'; it has id, split\n");
  EXPECT_EQ(tacipc("table t.csv --where x"), 2);
  EXPECT_EQ(said_, "tacipc table: error: --where 'x': say COLUMN=VALUE\n");
  EXPECT_EQ(tacipc("table t.csv"), 1);
  EXPECT_EQ(said_, "tacipc table: error: t.csv:3: 1 fields, but there are 2 columns\n");
  EXPECT_EQ(tacipc("table none.csv"), 1);
  EXPECT_EQ(said_, "tacipc table: error: none.csv: cannot be read: No such file or directory\n");
}

}  // namespace file_commands_test
}  // namespace tacipc
