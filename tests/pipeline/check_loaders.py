"""Reads exports with the packages of PyPI that they are for, and holds what comes out against the shards.

check_loaders.py webdataset SCRATCH DATASET…: with datasets, webdataset and ray.data
check_loaders.py lerobot SCRATCH DATASET…: loads, normalises by quantiles, deletes, splits and merges with lerobot
check_loaders.py univtac DATASET…: by what UniVTAC's documentation says of its HDF5Handler
A DATASET has pack/ and repack/<layout>/."""
import glob, io, json, logging, os, re, shutil, sys, tempfile

import h5py
import numpy as np
from PIL import Image


def shards_of(dataset):
    return [h5py.File(path) for path in sorted(glob.glob(os.path.join(dataset, "pack/shards/*.h5")))]


def samples_of(dataset):
    return {name: sample for shard in shards_of(dataset) for name, sample in shard["data"].items()}


def kind_of(sample):
    free = any("object_" + what in sample["obs"] for what in ("velocity_mm_s", "spin_rad_s"))
    return sample.attrs["sensor_id"] + ("_grasp" if "series" in sample else "_free" if free else "")


def same(a, b):
    a, b = np.asarray(a), np.asarray(b)
    return a.shape == b.shape and np.array_equal(a, b, equal_nan=b.dtype.kind == "f")


# --- WebDataset ---


def decoded(name, value):
    """What one reader or another gives for a file, as an array or a dictionary."""
    if isinstance(value, Image.Image):
        return np.asarray(value)
    if isinstance(value, bytes):
        return np.asarray(Image.open(io.BytesIO(value))) if name.endswith("png") else json.loads(value)
    return value if isinstance(value, dict) else np.asarray(value)


def check_frame(samples, files, reader):
    """One frame as a dictionary: every field of the shard is there with the same numbers, and nothing else."""
    told = decoded("json", files["json"])
    sample, t = samples[told["id"]], told["frame"]
    seen = {"json"}
    assert files["__key__"] == f"{told['id'].replace('.', '_')}/frame_{t:04}", files["__key__"]
    for section in ("obs", "check", "sim", "variants"):
        if section not in sample:
            continue
        fields = []
        sample[section].visititems(lambda path, data: fields.append((path, data)) if isinstance(data, h5py.Dataset) else None)
        for path, data in fields:
            if not data.attrs["shape"].startswith("(T"):
                continue
            name = ("sim." if section == "sim" else "") + path.replace("/", ".")
            file = next((name.lower() + e for e in (".png", ".npy") if name.lower() + e in files), None)
            got = decoded(file, files[file]) if file else told[section][name]
            assert same(np.asarray(got).astype(data.dtype), data[t]), (reader, told["id"], t, name)
            if file:
                seen.add(file)
            else:
                wanted = float if data.dtype.kind == "f" else int
                assert all(type(v) is wanted for v in np.ravel(np.asarray(got, object))), (reader, name, got)
    assert seen == {name for name in files if not name.startswith("__")}, (reader, seen ^ set(files))
    for name, value in told["sample"].items():
        assert same(value, sample.attrs[name]) and type(value) is not type(None), (reader, name)


def check_webdataset(scratch, datasets_made):
    os.environ.update(HF_HOME=os.path.join(scratch, "hf"), HF_HUB_OFFLINE="1", RAY_USAGE_STATS_ENABLED="0", RAY_AUTH_MODE="disabled")
    import datasets, ray.data, webdataset

    datasets.disable_progress_bars()
    sockets = tempfile.mkdtemp(prefix="ray")  # a short path: sockets have no long ones
    ray.init(num_cpus=1, include_dashboard=False, log_to_driver=False, object_store_memory=200 << 20, _temp_dir=sockets, logging_level="ERROR")
    logging.getLogger("ray.data").setLevel(logging.ERROR)
    ray.data.DataContext.get_current().enable_progress_bars = False
    for dataset in datasets_made:
        samples, frames = samples_of(dataset), 0
        for kind in sorted({kind_of(sample) for sample in samples.values()}):
            tars = sorted(glob.glob(os.path.join(dataset, f"repack/webdataset/*/*-{kind}.tar")))
            wanted = sum(int(s.attrs["n_frames"]) for s in samples.values() if kind_of(s) == kind)
            loaded = datasets.load_dataset("webdataset", data_files=tars, split="train")
            assert len(loaded) == wanted > 0, (kind, len(loaded), wanted)
            text = str(loaded.features)
            assert "null" not in text, text
            for row in loaded:
                check_frame(samples, row, "datasets")
            count = 0
            for row in webdataset.WebDataset(tars, shardshuffle=False).decode():
                check_frame(samples, row, "webdataset")
                count += 1
            assert count == wanted
            rows = ray.data.read_webdataset(tars).take_all()
            for row in rows:
                check_frame(samples, row, "ray")
            assert len(rows) == wanted
            frames += wanted
        check_samples(dataset, samples)
        print(f"{dataset}: {frames} frames of {len(samples)} samples are the same in datasets, webdataset and ray")
    ray.shutdown()
    shutil.rmtree(sockets, ignore_errors=True)


def check_samples(dataset, samples):
    """What belongs to whole samples: all attributes, configurations, series."""
    import webdataset

    seen = set()
    for row in webdataset.WebDataset(sorted(glob.glob(os.path.join(dataset, "repack/webdataset/*/samples/*.tar"))), shardshuffle=False).decode():
        told, files = row["json"], {"json"}
        sample = samples[told["id"]]
        for name, value in sample.attrs.items():
            file = re.sub("_(yaml|csv)$", r".\1", name)
            if file == name:
                assert same(told["sample"][name], value), name
            else:
                files.add(file)
                assert row[file].decode() == value, name
        for section in ("series", "sim", "ensemble"):
            for name, data in sample[section].items() if section in sample else ():
                if section == "sim" and data.attrs["shape"].startswith("(T"):
                    continue
                file = f"{section}.{name}.npy".lower()
                files.add(file)
                assert row[file].dtype == data.dtype and same(row[file], data[...]), name
        assert files == {name for name in row if not name.startswith("__")}, files ^ set(row)
        seen.add(told["id"])
    assert seen == set(samples)


# --- LeRobot ---


def statistics(values):
    """Least, greatest, mean and deviation over all but the last axis."""
    return {"min": values.min(0), "max": values.max(0), "mean": values.mean(0), "std": values.std(0)}


def check_statistics(data, told, items, where):
    """`told` of all numeric features against the frames `items`, quantiles included."""
    for name, feature in data.meta.features.items():
        values = np.stack([np.asarray(item[name], np.float64) for item in items])
        if feature["dtype"] == "image":
            values = np.moveaxis(values, 1, -1)
        width = len(np.ravel(told[name]["mean"]))
        values = values.reshape(-1, width)
        values = values[np.isfinite(values).all(1)]
        scale = np.abs(values).max() + 1e-12
        for key, of in statistics(values).items():
            assert np.allclose(np.ravel(told[name][key]), of, rtol=1e-4, atol=1e-6 * scale), (where, name, key, told[name][key], of)
        assert told[name]["count"] == len(items), (where, name)
        quantiles = [np.ravel(told[name][key]) for key in ("q01", "q10", "q50", "q90", "q99")]
        assert all((a <= b).all() for a, b in zip(quantiles, quantiles[1:])), (where, name)
        if where != "edited":  # lerobot takes means of the episodes' quantiles
            for key, part in {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}.items():
                wanted = np.quantile(values, part, axis=0, method="inverted_cdf")
                assert np.allclose(np.ravel(told[name][key]), wanted, rtol=1e-4, atol=1e-6 * scale), (where, name, key)


def check_quantile_normaliser(data, items):
    """lerobot's normaliser brings the first and last percentile to −1 and 1 and back."""
    import torch
    from lerobot.configs.types import FeatureType, NormalizationMode, PolicyFeature
    from lerobot.processor import NormalizerProcessorStep, TransitionKey, UnnormalizerProcessorStep

    features = {}
    for name, feature in data.meta.features.items():
        shape = tuple(np.asarray(items[0][name]).shape)
        if name == "action":
            features[name] = PolicyFeature(FeatureType.ACTION, shape)
        elif name.startswith("observation."):
            features[name] = PolicyFeature(FeatureType.VISUAL if feature["dtype"] == "image" else FeatureType.STATE, shape)
    modes = {kind: NormalizationMode.QUANTILES for kind in (FeatureType.VISUAL, FeatureType.STATE, FeatureType.ACTION)}
    arguments = dict(features=features, norm_map=modes)
    normalise = NormalizerProcessorStep.from_lerobot_dataset(data, **arguments)
    back = UnnormalizerProcessorStep.from_lerobot_dataset(data, **arguments)
    batch = {name: torch.stack([torch.as_tensor(item[name]) for item in items]) for name in features}
    observation = {name: values for name, values in batch.items() if name != "action"}
    out = normalise({TransitionKey.OBSERVATION: observation, TransitionKey.ACTION: batch["action"]})
    for name, values in batch.items():
        got = out[TransitionKey.ACTION] if name == "action" else out[TransitionKey.OBSERVATION][name]
        low, high = (torch.as_tensor(data.meta.stats[name][q], dtype=torch.float32) for q in ("q01", "q99"))
        wanted = 2 * (values - low) / torch.where(high == low, torch.tensor(1e-8), high - low) - 1
        assert got.shape == values.shape and torch.allclose(got, wanted, equal_nan=True), name
    assert torch.allclose(back(out)[TransitionKey.ACTION], batch["action"], atol=1e-6)


def check_lerobot(scratch, datasets_made):
    os.environ.update(HF_HOME=os.path.join(scratch, "hf"), HF_HUB_OFFLINE="1")
    import lerobot_on_debian  # noqa: F401
    import datasets, lerobot
    from lerobot.datasets.dataset_tools import delete_episodes, merge_datasets, split_dataset
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    datasets.disable_progress_bars()
    logging.disable(logging.WARNING)
    for number, dataset in enumerate(datasets_made):
        samples = samples_of(dataset)
        for root in sorted(glob.glob(os.path.join(dataset, "repack/lerobot/*/"))):
            kind = os.path.basename(root[:-1])
            data = LeRobotDataset("local/" + kind, root=root)
            items = [data[i] for i in range(len(data))]
            assert len(items) == data.meta.total_frames > 0
            check_statistics(data, data.meta.stats, items, "whole")
            check_quantile_normaliser(data, items)
            if kind.endswith("_grasp"):
                check_grasps(samples, root, data, items)
            episodes = data.meta.total_episodes
            if episodes < 3:
                continue
            to = os.path.join(scratch, f"edited_{number}_{kind}")
            fewer = delete_episodes(data, [1], output_dir=to + "/fewer", repo_id="local/fewer")
            kept = [item for item in items if item["episode_index"] != 1]
            check_edited(fewer, kept)
            parts = split_dataset(data, {"a": [0, 1], "b": list(range(2, episodes))}, output_dir=to + "/parts")
            check_edited(parts["a"], [item for item in items if item["episode_index"] < 2])
            check_edited(parts["b"], [item for item in items if item["episode_index"] >= 2])
            merged = merge_datasets([parts["a"], parts["b"]], "local/merged", output_dir=to + "/merged")
            check_edited(merged, items)
            print(f"{root}: lerobot {lerobot.__version__} loads {episodes} episodes, deletes, splits and merges them")


def check_edited(data, items):
    """The frames that an edit should have left, in order, and statistics of these."""
    assert len(data) == len(items), (len(data), len(items))
    new = [data[i] for i in range(len(data))]
    for got, wanted in zip(new, items):
        for name in data.meta.features:
            if name not in ("index", "episode_index", "task_index"):
                assert same(np.asarray(got[name]), np.asarray(wanted[name])), name
        assert got["task"] == wanted["task"]
    numbered = [{**item, "index": new[i]["index"], "episode_index": new[i]["episode_index"], "task_index": new[i]["task_index"]}
                for i, item in enumerate(items)]
    told = {name: of for name, of in data.meta.stats.items() if name not in ("index", "episode_index", "task_index")}
    check_statistics(Without(data, told), told, numbered, "edited")


class Without:
    """A dataset of which only the features with statistics in `told` are looked at."""

    def __init__(self, data, told):
        self.meta = type("Meta", (), {"features": {n: f for n, f in data.meta.features.items() if n in told}})


def check_grasps(samples, root, data, items):
    """Both fingers in one episode, each with its own image and wrench; hand, grip and object from the series."""
    import pyarrow.parquet as parquet

    rows = parquet.read_table(os.path.join(root, "meta/episodes/chunk-000/file-000.parquet")).to_pylist()
    for item in items:
        left = samples[rows[int(item["episode_index"])]["sample"]]
        right = next(s for s in samples.values() if s.attrs.get("grasp") == left.attrs["grasp"] and s.attrs["finger"] == "right")
        t = int(item["frame_index"])
        p = int(left["obs/frame"][t])
        for side, finger in (("left", left), ("right", right)):
            assert same(np.rint(np.moveaxis(np.asarray(item["observation.images.tactile_" + side]), 0, -1) * 255), finger["obs/rgb"][t])
            wrench = np.concatenate([finger["obs/force_N"][t], 1e-3 * finger["obs/torque_Nmm"][t].astype(float)])
            assert np.allclose(item["observation.wrench.tactile_" + side], wrench, atol=1e-7)
            field = np.asarray(item["observation.tactile.force_field_" + side]).reshape(data.meta.features["observation.tactile.force_field_" + side]["rows"])
            assert same(field, finger["obs/force_field_N"][t])
        assert np.allclose(item["observation.grip"], [left["obs/press_force_N"][t], right["obs/press_force_N"][t]])
        fingers = left["series/finger_pose"][p]
        hand = np.concatenate([left["series/hand_pose"][p], [np.linalg.norm(fingers[1, :3] - fingers[0, :3])]])
        hand[[0, 1, 2, 7]] *= 1e-3
        assert np.allclose(item["observation.state"], hand, atol=1e-6)
        assert np.allclose(item["observation.object_pose"], left["series/object_pose"][p] * ([1e-3] * 3 + [1] * 4), atol=1e-6)
    names = data.meta.features["observation.state"]["names"]
    assert names == ["x", "y", "z", "qx", "qy", "qz", "qw", "opening"], names
    assert data.meta.features["observation.grip"]["names"] == ["left", "right"]


# --- UniVTAC ---


def univtac_read(node):
    """UniVTAC's rule (docs/Collection.md, envs/utils/data.py): what has "rgb" in its name is a row of encoded images, which
    OpenCV decodes in the order B, G, R; groups are dictionaries, all else arrays."""
    out = {}
    for name, item in node.items():
        if isinstance(item, h5py.Group):
            out[name] = univtac_read(item)
        elif "rgb" in name:
            streams = item[()]
            assert streams.dtype.kind == "S" and streams.ndim == 1, name
            out[name] = np.stack([np.asarray(Image.open(io.BytesIO(bytes(s))).convert("RGB"))[..., ::-1] for s in streams])
        else:
            out[name] = item[()]
    return out


def metres(pose):
    return np.asarray(pose)[..., [0, 1, 2, 6, 3, 4, 5]] * ([1e-3] * 3 + [1] * 4)


def check_univtac(datasets_made):
    for dataset in datasets_made:
        samples, seen = samples_of(dataset), set()
        for folder in sorted(glob.glob(os.path.join(dataset, "repack/univtac/*/*/hdf5"))):
            kind, split = folder.split("/")[-3:-1]
            lengths = 0
            for path in sorted(glob.glob(folder + "/*.hdf5"), key=lambda p: int(os.path.basename(p)[:-5])):
                with h5py.File(path) as file:
                    episode, name = univtac_read(file), file.attrs["id"]
                    assert "no robot" in file["embodiment/joint"].attrs["absent"]
                sample = samples[name]
                frames = int(sample.attrs["n_frames"])
                assert sample.attrs["split"] == split and str(sample.attrs["index"]) == os.path.basename(path)[:-5]
                assert len(episode["step"]) == len(episode["embodiment"]["joint"]) == frames and same(episode["step"], sample["obs/frame"])
                assert episode["embodiment"]["joint"].shape == (frames, 0)
                fingers = {"left_tactile": sample}
                if kind.endswith("_grasp"):
                    fingers["right_tactile"] = next(s for s in samples.values() if s.attrs.get("grasp") == name and s.attrs["finger"] == "right")
                    rows = sample["obs/frame"][...]
                    assert np.allclose(episode["embodiment"]["ee"], metres(sample["series/hand_pose"][...][rows]), atol=1e-6)
                    assert np.allclose(episode["actor"][sample.attrs["object_id"]], metres(sample["series/object_pose"][...][rows]), atol=1e-6)
                else:
                    assert np.allclose(episode["actor"][sample.attrs["object_id"]], metres(sample["obs/object_pose"]), atol=1e-6)
                assert set(episode["tactile"]) == set(fingers)
                for side, finger in fingers.items():
                    got = episode["tactile"][side]
                    for theirs, ours in {"rgb": "rgb", "rgb_marker": "rgb_marker", "depth": "camera_depth_mm",
                                         "press_depth": "indentation_mm", "marker": "marker_px"}.items():
                        if ours in finger["obs"]:
                            assert same(got[theirs], finger["obs"][ours]), (path, side, theirs)
                    pose = np.array([[0, 0, 0, 1, 0, 0, 0]] * frames, float)
                    if kind.endswith("_grasp"):
                        pose = metres(sample["series/finger_pose"][...][rows, 0 if side == "left_tactile" else 1])
                    assert np.allclose(got["pose"], pose, atol=1e-6)
                    seen.add(finger.name.split("/")[-1])
                lengths += frames
            assert lengths > 0
        alone = {n for n, s in samples.items() if "series" in s and n not in seen}
        assert seen | alone == set(samples)
        for name in alone:  # the other finger failed
            assert sum(s.attrs.get("grasp") == samples[name].attrs["grasp"] for s in samples.values()) == 1, name
        print(f"{dataset}: {len(seen)} samples are read by the rules of UniVTAC, {len(alone)} fingers left out")


if __name__ == "__main__":
    what, *rest = sys.argv[1:]
    if what == "univtac":
        check_univtac(rest)
    else:
        {"webdataset": check_webdataset, "lerobot": check_lerobot}[what](rest[0], rest[1:])
