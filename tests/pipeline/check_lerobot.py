"""Reads a LeRobot dataset with pyarrow and holds every number and pixel against the shards it was made of.

check_lerobot.py DATASET SHARD...: DATASET/meta/info.json …, shards as HDF5"""
import glob, io, json, os, sys

import h5py
import numpy as np
import pyarrow.parquet as parquet
from PIL import Image

root, shards = sys.argv[1], sys.argv[2:]
info = json.load(open(os.path.join(root, "meta/info.json")))
stats = json.load(open(os.path.join(root, "meta/stats.json")))
assert info["codebase_version"] == "v3.0" and info["video_path"] is None

samples = {}
for path in shards:
    with h5py.File(path) as shard:
        for name, sample in shard["data"].items():
            if sample.attrs["sensor_id"] == os.path.basename(os.path.normpath(root)) and "series" not in sample:
                samples[name] = dict({k: v[...] for k, v in sample["obs"].items()}, attributes=dict(sample.attrs))

table = parquet.read_table(os.path.join(root, "meta/tasks.parquet"))
assert json.loads(table.schema.metadata[b"pandas"])["index_columns"] == ["task"]
tasks = table.column("task").to_pylist()
assert table.column("task_index").to_pylist() == list(range(len(tasks))) == list(range(info["total_tasks"]))
episodes = parquet.read_table(os.path.join(root, "meta/episodes/chunk-000/file-000.parquet")).to_pylist()
assert {e["sample"] for e in episodes} == set(samples) and len(episodes) == info["total_episodes"]
files = {}
for path in glob.glob(os.path.join(root, "data/*/*.parquet")):
    file = parquet.ParquetFile(path)
    assert file.schema_arrow.names == list(info["features"]), "columns are not the features"
    assert {"huggingface"} == {k.decode() for k in file.schema_arrow.metadata if k != b"ARROW:schema"}
    files[os.path.relpath(path, root)] = file


def pixels(cell):
    return np.asarray(Image.open(io.BytesIO(cell["bytes"])))


def wanted(feature, obs, t):
    last = len(obs["time_s"]) - 1
    pose = obs["object_pose"] * np.array([1e-3] * 3 + [1] * 4)
    return {
        "observation.images.tactile": lambda: obs["rgb"][t],
        "observation.images.tactile_marker": lambda: obs["rgb_marker"][t],
        "observation.images.indentation": lambda: obs["indentation_mm"][t],
        "observation.tactile.marker_displacement": lambda: 1e-3 * np.ravel(obs["marker_mm"][t].astype(float) - obs["marker_mm"][0].astype(float)),
        "observation.tactile.force_field": lambda: np.ravel(obs["force_field_N"][t]),
        "observation.wrench.tactile": lambda: np.concatenate([obs["force_N"][t], 1e-3 * obs["torque_Nmm"][t].astype(float)]),
        "observation.force": lambda: obs["press_force_N"][t],
        "observation.state": lambda: pose[t],
        "time": lambda: obs["time_s"][t],
        "action": lambda: pose[min(t + 1, last)],
    }[feature]()


def check_statistics(name, told, frames_of):
    every = np.concatenate(frames_of)
    scale = 1e-7 * np.abs(every).max()
    for key, of in {"min": every.min(0), "max": every.max(0), "mean": every.mean(0), "std": every.std(0)}.items():
        assert np.allclose(np.ravel(told[key]), of, rtol=1e-5, atol=scale), (name, key)
    for key, part in {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}.items():
        assert np.allclose(np.ravel(told[key]), np.quantile(every, part, axis=0, method="inverted_cdf"), rtol=4e-5, atol=scale), (name, key)
    assert told["count"] == [len(frames_of)], name
    assert len(told) == 10


frames, seen = 0, {}
for number, episode in enumerate(episodes):
    assert episode["episode_index"] == number and episode["dataset_from_index"] == frames
    obs = samples[episode["sample"]]
    assert episode["length"] == len(obs["time_s"]) == episode["dataset_to_index"] - episode["dataset_from_index"]
    first, end = map(int, info["splits"][obs["attributes"]["split"]].split(":"))
    assert first <= number < end, "an episode outside the range of its split"
    path = info["data_path"].format(chunk_index=episode["data/chunk_index"], file_index=episode["data/file_index"])
    group = sum(e["data/file_index"] == episode["data/file_index"] for e in episodes[:number])  # one row group each
    rows = files[path].read_row_group(group).to_pylist()
    assert len(rows) == episode["length"]
    part = {}
    for t, row in enumerate(rows):
        assert (row["frame_index"], row["episode_index"], row["index"]) == (t, number, frames + t)
        assert np.isclose(row["timestamp"], t / info["fps"]) and [tasks[row["task_index"]]] == episode["tasks"]
        for name, feature in info["features"].items():
            if name in ("timestamp", "frame_index", "episode_index", "index", "task_index"):
                continue
            value = wanted(name, obs, t)
            if feature["dtype"] == "image":
                got = pixels(row[name])
                assert got.dtype == value.dtype and np.array_equal(got, value), (episode["sample"], t, name)
                assert list(got.shape) == feature["shape"][: got.ndim]
            else:
                got = np.asarray(row[name], np.float32)
                assert np.array_equal(got, np.asarray(value, np.float64).astype(np.float32)), (episode["sample"], t, name)
                assert list(got.shape or (1,)) == feature["shape"]
            scale = 255.0 if got.dtype == np.uint8 else 1.0
            width = 1 if "rows" in feature else feature["shape"][-1]  # rows of equal numbers are counted together
            assert np.prod(feature.get("rows", feature["shape"])) == np.prod(feature["shape"])
            seen.setdefault(name, []).append(got.reshape(-1, width).astype(np.float64) / scale)
            part.setdefault(name, []).append(seen[name][-1])
        for name in ("timestamp", "frame_index", "episode_index", "index", "task_index"):
            seen.setdefault(name, []).append(np.full((1, 1), row[name], np.float64))
            part.setdefault(name, []).append(seen[name][-1])
    for name, values in part.items():
        told = {key[len(f"stats/{name}/"):]: value for key, value in episode.items() if key.startswith(f"stats/{name}/")}
        shape = (len(values[0][0]), 1, 1) if info["features"][name]["dtype"] == "image" else (len(values[0][0]),)
        assert all(np.shape(value) == (shape if key != "count" else (1,)) for key, value in told.items()), name
        check_statistics(name, told, values)
    frames += len(rows)
assert frames == info["total_frames"] > 0 and seen
assert list(stats) == list(info["features"])
for name, values in seen.items():
    check_statistics(name, stats[name], values)
print(f"{len(episodes)} episodes, {frames} frames, {len(seen)} features hold")
