"""Loads archives and folders that repack makes and holds them, number by number, against the shards.

check_repack.py SHARDS REPACK: SHARDS/<shard>/<shard>.h5 and REPACK/{webdataset,folder}/<shard>/"""
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


def check_samples(shard, frames, whole):
    """`frames`: sample → frame → extension → content; `whole`: sample → extension → content."""
    assert set(frames) == set(whole) == set(shard["data"])
    for name, sample in shard["data"].items():
        files, seen = whole[name], {"json"}
        for attribute, value in sample.attrs.items():
            extension = re.sub("_(yaml|csv)$", r".\1", attribute)
            if extension == attribute:
                assert same(files["json"]["sample"][attribute], value), attribute
            else:
                assert files[extension] == value
                seen.add(extension)
        assert sorted(frames[name]) == [f"frame_{t:04}" for t in range(sample.attrs["n_frames"])]
        assert len({tuple(sorted(frame)) for frame in frames[name].values()}) == 1, "frames of different files"
        seen_in = {frame: {"json"} for frame in frames[name]}

        def check(path, data):
            section, rest = path.split("/", 1)
            stem = {"obs": rest, "check": rest, "sim": f"sim.{rest}", "variants": rest.replace("/", ".")}[section]
            if not data.attrs["shape"].startswith("(T"):
                seen.add(stem.lower() + ".npy")
                assert files[stem.lower() + ".npy"].dtype == data.dtype and same(files[stem.lower() + ".npy"], data[...]), path
                return
            for frame, content in frames[name].items():
                told, value = content["json"], data[int(frame[-4:])]
                assert told["id"] == name and told["frame"] == int(frame[-4:])
                file = next((stem.lower() + e for e in (".png", ".npy") if stem.lower() + e in content), None)
                if file:
                    seen_in[frame].add(file)
                    assert content[file].dtype == data.dtype and same(content[file], value), path
                else:
                    assert value.size <= 16 and same(np.array(told[section][stem], data.dtype), value), path
                    assert all(type(v) is (float if data.dtype.kind == "f" else int) for v in np.ravel(np.array(told[section][stem], object))), path

        sample.visititems(lambda path, data: check(path, data) if isinstance(data, h5py.Dataset) else None)
        assert seen == set(files), seen ^ set(files)
        for frame, content in frames[name].items():
            assert seen_in[frame] == set(content), seen_in[frame] ^ set(content)
            for attribute, value in content["json"]["sample"].items():
                assert same(sample.attrs[attribute], value), attribute


def members(path):
    """WebDataset's rule: a key is the path up to the first dot of the file's name; files of a key follow each other."""
    grouped, order = {}, []
    with tarfile.open(path) as tar:
        for member in tar:
            key, extension = re.fullmatch(r"((?:.*/)?[^.]+)[.]([^/]*)", member.name).groups()
            assert member.mtime == 0 and member.isfile() and extension == extension.lower()
            grouped.setdefault(key, {})[extension] = load(member.name, tar.extractfile(member).read())
            order += [key] if order[-1:] != [key] else []
    assert len(order) == len(grouped)
    return grouped


count = 0
for folder in sorted(glob.glob(os.path.join(shards, "*/"))):
    name = os.path.basename(folder[:-1])
    with h5py.File(os.path.join(folder, name + ".h5")) as shard:
        root, frames = os.path.join(repack, "webdataset", name), {}
        for path in glob.glob(os.path.join(root, "*.tar")):
            kind = re.fullmatch(re.escape(name) + "-(.*)[.]tar", os.path.basename(path))[1]
            for key, content in members(path).items():
                sample, frame = key.split("/")
                assert shard["data"][sample].attrs["sensor_id"] == kind
                frames.setdefault(sample, {})[frame] = content
        check_samples(shard, frames, members(os.path.join(root, "samples", name + ".tar")))

        plain, whole, root = {}, {}, os.path.join(repack, "folder", name)
        for path in glob.glob(os.path.join(root, "*/*")):
            sample, file = os.path.relpath(path, root).split("/")
            content = load(path, open(path, "rb").read())
            if file.startswith("frame_"):
                frame, extension = file.split(".", 1)
                plain.setdefault(sample, {}).setdefault(frame, {})[extension] = content
            else:
                whole.setdefault(sample, {})["json" if file == "sample.json" else file] = content
        check_samples(shard, plain, whole)
        fields = json.load(open(os.path.join(root, "fields.json")))
        for sample in shard["data"].values():
            assert fields["fields"]["indentation_mm"] == dict(sample["obs/indentation_mm"].attrs)
            count += 1
        assert all(same(fields["sensors"][s][k], v) for s in shard["sensors"] for k, v in shard["sensors"][s].attrs.items())
assert count > 0
print(f"{count} samples hold in both layouts")
