"""Shards of strangers through repack (all layouts), card and check_labels.py: each is read or refused by one clear message.

strange_shards.py BIN SOURCE_DIR DATASET CAGE COUNT [FIRST]: DATASET has plan/ and shards/ with one shard. First shards that point
elsewhere or lie about sizes, then COUNT mutations from number FIRST on, the same ones every time; all are written into CAGE, a
copy of DATASET, and nothing may be written beside the programs' folders in it. Ends with a line of counts; what is wrong is printed, exit 1."""
import collections, concurrent.futures, hashlib, importlib.util, json, os, random, re, shutil, struct, subprocess, sys, zlib

import h5py
import numpy as np

binaries, source, dataset, cage, count = sys.argv[1:6]
first = int(sys.argv[6]) if len(sys.argv) > 6 else 0
spec = importlib.util.spec_from_file_location("check_labels", source + "/configs/datasets/card/check_labels.py")
check_labels = importlib.util.module_from_spec(spec)
spec.loader.exec_module(check_labels)

LAYOUTS = "folder", "webdataset", "univtac", "lerobot"
NAME = open(dataset + "/shards/shards.txt").read().split("/")[0]
LONGEST_S = 120  # the programs give one call of a library 60
cage = os.path.realpath(cage)
shutil.copytree(dataset, cage)
shard = f"{cage}/given/{NAME}/{NAME}.h5"  # without a record of pack, which would say that it has changed
packed = f"{cage}/shards/{NAME}/{NAME}.h5"  # for card: the same file
shutil.copytree(dataset + "/shards", cage + "/given")
open(os.path.dirname(shard) + "/pack.yaml", "w").write("stage: pack\n")
whole = open(shard, "rb").read()
record = open(os.path.dirname(packed) + "/pack.yaml").read()
os.environ["ASAN_OPTIONS"] = "abort_on_error=1:detect_leaks=0:handle_segv=0:handle_sigbus=0:handle_abort=0"
os.environ["UBSAN_OPTIONS"] = "halt_on_error=1:abort_on_error=1"
counts, faults = collections.Counter(), []


def files_beside():
    """All files but those in the folders of programs."""
    own = tuple(f"{cage}/{program}/" for program in (*LAYOUTS, "card"))
    return {path for folder, _, files in os.walk(os.path.dirname(cage)) for path in (os.path.join(folder, f) for f in files)
            if not path.startswith(own)}


def run(program, out, arguments):
    """Exit code and message of a program that writes to `out`; what it must not do goes to faults."""
    shutil.rmtree(out, ignore_errors=True)
    try:
        done = subprocess.run([f"{binaries}/{program}", *arguments, "--out", out, "--log-level", "error", "--threads", "1"], cwd=cage,
                              capture_output=True, text=True, errors="replace", timeout=LONGEST_S)
        code, said = done.returncode, done.stderr
    except subprocess.TimeoutExpired:
        code, said = -1, "hangs"
    wrong = []
    # What a sanitizer sees in the library itself is a crash of that, which the program has caught.
    if ("Sanitizer" in said or "runtime error" in said) and "libhdf5 crashed" not in said:
        wrong.append("a sanitizer has found something")
    elif code not in (0, 1):
        wrong.append(f"ended with {code}")
    elif code == 1 and not re.fullmatch(r"\w+: error: [^\n]{10,900}\n", said if "Sanitizer" not in said else said[said.rindex(program + ":"):]):
        wrong.append("does not say why in one line")
    if code == 1 and [name for name in os.listdir(out) if name not in (f"{program}.failed.yaml", f"{program}.log", f".lock-{program}")]:
        wrong.append(f"left {os.listdir(out)}")
    if code == 0:
        wrong += faulty_json(out)
    return code, said, wrong


def faulty_json(out):
    def no_number(word):
        raise ValueError(word)
    for folder, _, files in os.walk(out):
        for name in files:
            if name.endswith(".json"):
                try:
                    json.load(open(os.path.join(folder, name), encoding="utf-8"), parse_constant=no_number)
                except ValueError as error:
                    return [f"{name} is no JSON: {error}"]
    return []


def give(content):
    """Puts a shard in its place, with the digests that tell it to be whole."""
    digest = hashlib.sha256(content).hexdigest()
    for path in shard, packed:
        with open(path, "wb") as file:
            file.write(content)
        with open(path + ".sha256", "w") as file:
            file.write(f"{digest}  {NAME}.h5\n")
    with open(os.path.dirname(packed) + "/pack.yaml", "w") as file:
        file.write(re.sub(r"(?m)^(  sha256: ).*", r"\g<1>" + digest, record))


def through(layout):
    config = f"{source}/configs/datasets/repack/{layout}.yaml"
    given = ["--shards", cage + "/given/shards.txt"] if layout in ("univtac", "lerobot") else ["--shard", shard]
    return run("repack", f"{cage}/{layout}", ["--config", config, *given])


def card():
    config = source + "/configs/datasets/card"
    return run("card", cage + "/card", ["--config", config + "/default.yaml", "--plan", cage + "/plan/samples.csv", "--dataset",
               cage + "/shards/dataset.yaml", "--shards", cage + "/shards/shards.txt", "--loader", config + "/loader.py", "--check-labels",
               config + "/check_labels.py"])


def checked():
    """Exit code as check_labels.py has it, and the lines that it would print."""
    lines = list(check_labels.answers_of(shard))
    wrong = [] if lines[-1][0] is None else ["check_labels.py does not end"]
    said = "\n".join(str(found) for _, found in lines if found)
    return int(bool(said)), said, wrong


def results():
    """(code, message, faults) of each program for the shard that is given. All run at once: some wait for the end of a hang."""
    before = files_beside()
    found = {program: pool.submit(card) if program == "card" else pool.submit(through, program) for program in (*LAYOUTS, "card")}
    found = {"check_labels.py": checked(), **{program: result.result() for program, result in found.items()}}
    for path in files_beside() - before:
        found["folder"][2].append(f"{path} was written beside the programs' folders")
    return found


def note(what, program, result):
    code, said, wrong = result
    counts[f"{program} {'reads' if code == 0 else 'refuses'}"] += 1
    if "libhdf5 crashed" in said or "crashed (" in said:
        counts[f"{program} says that libhdf5 crashed"] += 1
    if "not done after" in said or "nothing was read in" in said:
        counts[f"{program} says that libhdf5 hung"] += 1
    for fault in wrong:
        faults.append(f"{what}: {program}: {fault}: {said.strip()[-2000:]}")
        print(faults[-1], flush=True)


def with_checksums(content):
    """Object headers and superblock with the checksums that they should have, which no chance hits."""
    content = bytearray(content)
    if content[8:9] == b"\2" and len(content) >= 48:
        content[44:48] = struct.pack("<I", lookup3(bytes(content[:44])))
    for found in re.finditer(b"OHDR\2", bytes(content)):
        at, flags = found.start(), content[found.start() + 5] if found.start() + 5 < len(content) else 0
        end = at + 6 + (16 if flags & 32 else 0) + (4 if flags & 16 else 0)
        width = 1 << (flags & 3)
        end += width + int.from_bytes(content[end:end + width], "little")
        if end - at < 1 << 16 and end + 4 <= len(content):
            content[end:end + 4] = struct.pack("<I", lookup3(bytes(content[at:end])))
    return bytes(content)


def lookup3(data):
    """Jenkins' hash of HDF5's metadata."""
    mask = 0xffffffff
    turn = lambda x, k: (x << k | x >> (32 - k)) & mask
    a = b = c = (0xdeadbeef + len(data)) & mask
    at = 0
    while len(data) - at > 12:
        x, y, z = struct.unpack_from("<III", data, at)
        a, b, c = (a + x) & mask, (b + y) & mask, (c + z) & mask
        a = (a - c) & mask ^ turn(c, 4); c = (c + b) & mask
        b = (b - a) & mask ^ turn(a, 6); a = (a + c) & mask
        c = (c - b) & mask ^ turn(b, 8); b = (b + a) & mask
        a = (a - c) & mask ^ turn(c, 16); c = (c + b) & mask
        b = (b - a) & mask ^ turn(a, 19); a = (a + c) & mask
        c = (c - b) & mask ^ turn(b, 4); b = (b + a) & mask
        at += 12
    if at == len(data):
        return c
    x, y, z = struct.unpack("<III", data[at:].ljust(12, b"\0"))
    a, b, c = (a + x) & mask, (b + y) & mask, (c + z) & mask
    c = ((c ^ b) - turn(b, 14)) & mask
    a = ((a ^ c) - turn(c, 11)) & mask
    b = ((b ^ a) - turn(a, 25)) & mask
    c = ((c ^ b) - turn(b, 16)) & mask
    a = ((a ^ c) - turn(c, 4)) & mask
    b = ((b ^ a) - turn(a, 14)) & mask
    return ((c ^ b) - turn(b, 24)) & mask


assert with_checksums(whole) == whole, "the checksums are not HDF5's"
STRUCTURES = [found.start() for found in re.finditer(b"OHDR|OCHK|GCOL|TREE|SNOD|HEAP|FRHP|FHDB|FHIB|BTHD|BTIN|BTLF|\x89HDF", whole)]


def mutated(number):
    """The shard with one to four changes, most of them where its structures are."""
    rng = random.Random(number)
    content = bytearray(whole)
    for _ in range(rng.randint(1, 4)):
        size = len(content)
        at = rng.randrange(size) if rng.random() < 0.3 else min(rng.choice(STRUCTURES) + rng.randrange(256), size - 1)
        kind, length = rng.randrange(20), rng.randint(1, 64)
        if kind < 8:
            content[at] ^= 1 << rng.randrange(8)
        elif kind < 12:
            content[at:at + 4] = bytes([rng.choice(b"\x00\x7f\x80\xff")]) * min(4, size - at)
        elif kind < 16:  # a length
            width = rng.choice([1, 2, 4, 8])
            value = rng.choice([0, 1, 255, 65535, 2**31, 2**32 - 1, 2**63, 2**64 - 1, 10**12, size, at])
            content[at:at + width] = (value & (256**width - 1)).to_bytes(width, "little")[:size - at]
        elif kind < 18:  # two blocks change places
            other = min(rng.choice(STRUCTURES) + rng.randrange(256), size - 1)
            length = min(length, size - max(at, other), abs(at - other))
            content[at:at + length], content[other:other + length] = content[other:other + length], content[at:at + length]
        elif kind < 19:
            content[at:at + length] = bytes(min(length, size - at))
        else:
            del content[max(at, 100):]
    return with_checksums(bytes(content)) if rng.random() < 0.75 else bytes(content)


# What a stranger may do: how the shard is changed, for whom, and what is said.
SECRET = "not for strangers"
ALL = *LAYOUTS, "check_labels.py"


def strange():
    """(name, what changes the shard, programs that must refuse it, words of the message)"""
    with h5py.File(shard, "r") as f:
        press = next(s for s in f["data"] if "grasp" not in f["data"][s].attrs)
        left = next(s for s in f["data"] if f["data"][s].attrs.get("finger") == "left")
        image = f["data"][press]["obs/rgb"].shape
    other = cage + "/other.h5"
    with h5py.File(other, "w") as f:
        f["numbers"] = np.frombuffer(SECRET.encode().ljust(int(np.prod(image))), np.uint8).reshape(image)
        f["group"] = 1

    def attribute(name, value, at="data/" + press):
        def change(f):
            if name in f[at].attrs:
                del f[at].attrs[name]
            f[at].attrs[name] = value
        return change

    def again(path, make, sample=press):
        """The dataset made again, with its attributes."""
        def change(f):
            group, _, name = f"data/{sample}/{path}".rpartition("/")
            old = f[group][name]
            attributes, values = dict(old.attrs), old[...]
            del f[group][name]
            make(f[group], name, values)
            for key, value in attributes.items():
                f[group][name].attrs[key] = value
        return change

    def link(path, to):
        def change(f):
            if path in f:
                del f[path]
            f[path] = to
        return change

    def with_chunk(stream, shape=None):
        def make(group, name, values):
            shape_ = shape or values.shape
            new = group.create_dataset(name, shape_, values.dtype, chunks=(1, *shape_[1:]), compression="gzip", shuffle=False)
            for t in range(values.shape[0]):
                new.id.write_direct_chunk((t, *[0] * (len(shape_) - 1)), stream)
        return make

    def external(group, name, values):
        group.create_dataset(name, values.shape, values.dtype, external=[(other, 2048, values.nbytes)])

    def virtual(group, name, values):
        layout = h5py.VirtualLayout(values.shape, values.dtype)
        layout[...] = h5py.VirtualSource(other, "numbers", values.shape)
        group.create_virtual_dataset(name, layout)

    plain = lambda change: lambda group, name, values: group.create_dataset(name, data=change(values))
    rows = lambda group, name, values: group.create_dataset(name, (10**12, *values.shape[1:]), values.dtype, chunks=(1, *values.shape[1:]))
    files, episodes, rgb = ("folder", "webdataset"), ("univtac", "lerobot"), f"data/{press}/obs/rgb"
    named = "a name has letters"
    yield "sample ..", lambda f: f["data"].move(press, ".."), LAYOUTS, named
    yield "sample .hidden", lambda f: f["data"].move(left, ".hidden"), LAYOUTS, named
    yield "field ..", lambda f: f[f"data/{press}/obs"].move("rgb", ".."), files, named
    yield "variant ..", lambda f: f.copy(f"data/{press}/obs", f"data/{press}/variants/.."), files, named
    yield "shard ../up", attribute("shard", "../up", "/"), files, named
    yield "sensor ../../up", attribute("sensor_id", "../../up"), ("webdataset", *episodes), named
    yield "split ../../up", attribute("split", "../../up"), ("univtac",), named
    yield "object a/b", attribute("object_id", "a/b"), ("univtac",), named
    yield "configuration ../up", attribute("../up_yaml", "x: 1"), files, named
    yield "configuration that is no text", attribute("press_yaml", 3), files, "is not a text"
    for path in rgb, f"data/{press}", f"data/{press}/obs", "data":
        who = LAYOUTS if path != rgb else ALL
        yield f"{path} in another file", link(path, h5py.ExternalLink(other, "/group")), ALL, "link"
        yield f"{path} by a soft link", link(path, h5py.SoftLink("/mask")), ALL, "link"
    yield "external storage", again("obs/rgb", external), ALL, "in another file|in other files"
    yield "virtual dataset", again("obs/rgb", virtual), ALL, "in other files"
    yield "pose of three columns", again("obs/object_pose", plain(lambda v: v[:, :3])), episodes, "object_pose: is 2 x 3"
    yield "pose without columns", again("obs/object_pose", plain(lambda v: v[:, 0])), episodes, "object_pose: is 2 of"
    yield "shorter images", again("obs/rgb", plain(lambda v: v[:1])), LAYOUTS, "obs/rgb: is"
    yield "shorter map", again("obs/indentation_mm", plain(lambda v: v[:1])), LAYOUTS, "obs/indentation_mm: is"
    yield "images of two channels", again("obs/rgb", plain(lambda v: v[..., :2])), episodes, "obs/rgb: is"
    yield "signed images", again("obs/rgb", plain(lambda v: v.astype(np.int8))), LAYOUTS, "a number type"
    yield "poses of whole numbers", again("obs/object_pose", plain(lambda v: v.astype(np.int32))), episodes, "must be 2 x 7 of reals"
    yield "texts for numbers", again("obs/press_force_N", plain(lambda v: np.array(["a", "b"], dtype=h5py.string_dtype()))), LAYOUTS, "no numbers"
    yield "hands of six columns", again("series/hand_pose", plain(lambda v: v[:, :6]), left), ALL[2:], "hand_pose|cannot be checked"
    yield "one finger", again("series/finger_pose", plain(lambda v: v[:, :1]), left), episodes, "finger_pose: is"
    yield "shorter series", again("series/object_pose", plain(lambda v: v[:2]), left), ALL[2:], "object_pose|cannot be checked"
    yield "no series", lambda f: f[f"data/{left}/series"].move("hand_pose", "hand"), ALL[2:], "hand_pose"
    for value in -1, 3, 10**12, 2.0, "two":
        yield f"{value!r} frames", attribute("n_frames", value), LAYOUTS, "n_frames|frames|obs/"
    yield "10^12 rows", again("obs/force_N", rows), (*LAYOUTS, "check_labels.py"), "cannot hold"
    yield "10^12 rows of a series", again("series/time_s", rows, left), (*episodes, *files, "check_labels.py"), "cannot hold"
    yield "frames too large", again("obs/rgb", with_chunk(zlib.compress(b"\0" * 10**6), (2, 20000, 20000, 3))), LAYOUTS, "cannot hold|at most"
    yield "a frame that unpacks to more", again("obs/rgb", with_chunk(zlib.compress(b"\0" * 2**28))), LAYOUTS, "frame 0 is damaged"
    yield "a frame that unpacks to less", again("obs/rgb", with_chunk(zlib.compress(b"\0" * 9))), LAYOUTS, "frame 0 is damaged"
    yield "a frame that is no stream", again("obs/rgb", with_chunk(b"no stream")), LAYOUTS, "frame 0 is damaged"
    yield "frames not there", again("obs/rgb", lambda g, n, v: g.create_dataset(n, v.shape, v.dtype, chunks=(1, *v.shape[1:]))), LAYOUTS, "cannot be read"
    yield "another filter", again("obs/rgb", lambda g, n, v: g.create_dataset(n, data=v, chunks=(1, *v.shape[1:]), compression="lzf")), LAYOUTS, "filters"
    yield "times that go back", again("obs/time_s", plain(lambda v: v[::-1])), episodes, "is no later one"
    yield "times that are none", again("obs/time_s", plain(lambda v: v * np.nan)), episodes, "is no later one"


pool = concurrent.futures.ThreadPoolExecutor(len(LAYOUTS) + 1)
give(whole)
for program, result in results().items():
    note("the shard of pack", program, result)
    if result[0] != 0:
        faults.append(f"the shard of pack: {program}: {result[1]}")
        print(faults[-1])
cases = list(strange())
for what, change, programs, words in cases:
    give(whole)
    with h5py.File(shard, "r+", libver="latest") as f:
        change(f)
    give(open(shard, "rb").read())
    for program, (code, said, wrong) in results().items():
        if program in programs and (code != 1 or not re.search(words, said)):
            wrong.append(f"must say '{words}', exit 1, but {code}")
        if program in LAYOUTS and subprocess.run(["grep", "-rqF", SECRET, f"{cage}/{program}"]).returncode == 0:
            wrong.append("shows what is in another file")
        note(what, program, (code, said, wrong))
for number in range(first, first + int(count)):
    give(mutated(number))
    for program, result in results().items():
        note(f"mutation {number}", program, result)
    if number % 100 == 99:
        print(f"{number + 1}: {dict(counts)}", flush=True)
print(f"{len(cases)} strange shards, {count} mutations: {len(faults)} faults; " + ", ".join(f"{name} {n}" for name, n in sorted(counts.items())))
sys.exit(1 if faults else 0)
