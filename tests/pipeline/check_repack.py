"""Loads the three layouts that repack makes and holds them, number by number, against the shards.

check_repack.py SHARDS REPACK: SHARDS/<shard>/<shard>.h5 and REPACK/{webdataset,univtac,folder}/<shard>/"""
import glob, io, json, os, re, sys, tarfile

import h5py
import numpy as np

from read_png import read_png

shards, repack = sys.argv[1:]


def same(a, b):
    a, b = np.asarray(a), np.asarray(b)
    assert a.shape == b.shape, (a.shape, b.shape)
    return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def load(name, data):
    if name.endswith(".png"):
        return read_png(data)
    if name.endswith(".npy"):
        return np.load(io.BytesIO(data))
    return json.loads(data) if name.endswith("json") else data.decode()


def check_frames(shard, frames):
    """`frames`: key → extension → content, as WebDataset groups files."""
    wanted = {f"{s}/frame_{t:04}" for s in shard["data"] for t in range(shard["data"][s].attrs["n_frames"])}
    assert set(frames) == wanted
    for key, files in frames.items():
        name, t = key.split("/")[0], int(key[-4:])
        sample, seen = shard["data"][name], {"json"}
        told = files["json"]
        assert told["id"] == name and told["frame"] == t
        for attribute, value in sample.attrs.items():
            if isinstance(value, str) and "\n" in value:  # a file of its own, with frame 0
                extension = attribute[:-5] + ".yaml" if attribute.endswith("_yaml") else attribute + ".txt"
                if t == 0:
                    assert files[extension] == value
                    seen.add(extension)
            else:
                assert told["sample"][attribute] == value, attribute

        def check(path, data):
            section, rest = path.split("/", 1)
            stem = {"obs": rest, "check": rest, "sim": f"sim.{rest}", "variants": rest.replace("/", ".")}[section]
            per_frame = data.attrs["shape"].startswith("(T")
            if not per_frame and t > 0:
                return
            value = data[t] if per_frame else data[...]
            for extension in (".png", ".npy"):
                if stem + extension in files:
                    seen.add(stem + extension)
                    assert files[stem + extension].dtype == data.dtype and same(files[stem + extension], value), path
                    return
            assert value.size <= 16 and same(np.array(told[section][stem], data.dtype), value), path

        sample.visititems(lambda path, data: check(path, data) if isinstance(data, h5py.Dataset) else None)
        assert seen == set(files), set(files) ^ seen


count = 0
for folder in sorted(glob.glob(os.path.join(shards, "*/"))):
    name = os.path.basename(folder[:-1])
    with h5py.File(os.path.join(folder, name + ".h5")) as shard:
        # WebDataset's rule: a key is the path up to the first dot of the file's name.
        grouped, order = {}, []
        with tarfile.open(os.path.join(repack, "webdataset", name, name + ".tar")) as tar:
            for member in tar:
                key, extension = re.fullmatch(r"((?:.*/)?[^.]+)[.]([^/]*)", member.name).groups()
                assert member.mtime == 0 and member.isfile()
                grouped.setdefault(key, {})[extension] = load(member.name, tar.extractfile(member).read())
                order += [key] if order[-1:] != [key] else []
        assert len(order) == len(grouped)  # files of a frame follow each other, as readers of tar ask for
        check_frames(shard, grouped)

        plain, root = {}, os.path.join(repack, "folder", name)
        for path in glob.glob(os.path.join(root, "*/*")):
            key, extension = re.fullmatch(r"([^/]*/[^.]*)[.](.*)", os.path.relpath(path, root)).groups()
            plain.setdefault(key, {})[extension] = load(path, open(path, "rb").read())
        check_frames(shard, plain)
        fields = json.load(open(os.path.join(root, "fields.json")))
        for sample in shard["data"].values():
            assert fields["fields"]["indentation_mm"] == dict(sample["obs/indentation_mm"].attrs)
        assert all(same(fields["sensors"][s][k], v) for s in shard["sensors"] for k, v in shard["sensors"][s].attrs.items())

        episodes = sorted(glob.glob(os.path.join(repack, "univtac", name, "*.hdf5")))
        assert [os.path.basename(e)[:-5] for e in episodes] == sorted(shard["data"])
        for episode in episodes:
            obs = shard["data"][os.path.basename(episode)[:-5]]["obs"]
            with h5py.File(episode) as theirs:
                left = theirs["tactile/left_tactile"]
                for a, b in {"rgb": "rgb", "rgb_marker": "rgb_marker", "depth": "camera_depth_mm",
                             "press_depth": "indentation_mm", "marker": "marker_px"}.items():
                    assert same(left[a], obs[b]) and left[a].attrs["unit"] == obs[b].attrs["unit"]
                pose = obs["object_pose"][...]
                assert same(left["pose"], pose[:, [0, 1, 2, 6, 3, 4, 5]]) and (left["pose"][:, 3] >= 0).all()
                assert left["pose"].attrs["quat_order"] == "wxyz"
                count += 1
assert count > 0
print(f"{count} samples hold in three layouts")
