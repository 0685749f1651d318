"""Loads a packed dataset as a user would, and holds it against what press left and schema.json says.

check_shard.py DATASET SOURCE_DIR: DATASET has samples/, plan/ and pack/."""
import csv, glob, json, os, re, sys

import h5py
import numpy as np
import torch

from read_png import read_png

dataset, source = sys.argv[1:]
pack = os.path.join(dataset, "pack")
schema = json.load(open(os.path.join(pack, "schema.json")))
planned = {row["id"]: row for row in csv.DictReader(open(os.path.join(dataset, "plan/samples.csv")))}
manifest = {row["id"]: row for row in csv.DictReader(open(os.path.join(pack, "manifest.csv")))}
assert list(manifest) == list(planned)


def picture(path):
    return read_png(open(path, "rb").read())


checked = 0
for path in sorted(glob.glob(os.path.join(pack, "shards/*.h5"))):
    with h5py.File(path) as f:
        assert f.attrs["format"] == "tactile-shard" and f.attrs["quat_order"] == "xyzw"
        split = os.path.basename(path).split("-")[0]
        assert [s.decode() for s in f[f"mask/{split}"]] == sorted(f["data"])
        for name, sample in f["data"].items():
            row, press = manifest[name], os.path.join(dataset, planned[name]["folder"], "press")
            render = os.path.join(dataset, planned[name]["folder"], "render")
            assert row["status"] == "made" and row["split"] == split == sample.attrs["split"]
            assert f"{row['shard']}.h5" == os.path.basename(path)
            frames = sample["obs/frame"][:]
            assert frames[0] == 0 and len(frames) == sample.attrs["n_frames"]
            # Everything loads, is as schema.json says, and is in one of its fields.
            letters = {}
            for field in schema["fields"]:
                group, key = field["path"].split("/")
                if not field["packed"]:
                    assert field["path"] not in sample
                    continue
                if group not in sample:
                    assert sample.attrs["absent_" + group]
                    continue
                if field["path"] not in sample:
                    assert sample[group].attrs["absent_" + key]
                    continue
                data = sample[field["path"]]
                assert data.dtype == np.dtype(field["dtype"]), field["path"]
                for attribute, value in data.attrs.items():
                    assert field[attribute] == value, (field["path"], attribute)
                shape = re.findall(r"\w+", field["shape"])
                assert len(shape) == data.ndim, (field["path"], data.shape)
                for letter, extent in zip(shape, data.shape):
                    assert int(letter) == extent if letter.isdigit() else letters.setdefault(letter, extent) == extent
                assert data[...].size
                if data[:1].nbytes >= 2048 and field["shape"].startswith("(T"):
                    assert data.chunks == (1,) + data.shape[1:] and data.compression == "gzip" and data.shuffle
            obs = {key: data[...] for key, data in sample["obs"].items()}
            # Against the files that press left, in SI.
            wrench, traction = np.load(press + "/wrench.npy")[frames], np.load(press + "/traction.npy")[frames]
            force = np.load(press + "/contact_force.npy")[frames]
            assert np.allclose(obs["force_N"], wrench[:, :3], atol=1e-6)
            assert np.allclose(obs["torque_Nmm"], 1e3 * wrench[:, 3:], atol=1e-4)
            assert np.allclose(obs["press_force_N"], -wrench[:, 2], atol=1e-6)
            assert np.allclose(obs["normal_force_N"] + obs["friction_force_N"], force.sum((1, 2)), atol=1e-6)
            assert np.allclose(obs["force_field_normal_N"] + obs["force_field_friction_N"], obs["force_field_N"], atol=1e-7)
            window = f["sensors"][sample.attrs["sensor_id"]].attrs["window_mm"]
            rows, columns = traction.shape[1:3]
            area = 1e-6 * window.prod() / (rows * columns)
            assert np.allclose(obs["force_field_N"], area * traction.sum(3), atol=1e-7)
            # The grid holds the force on the front's vertices inside the window, here all of them.
            where = np.load(press + "/positions.npy")[frames][:, np.load(press + "/front_vertices.npy"), :2]
            inside = (np.abs(where) < 0.5e-3 * window).all(-1)
            assert np.allclose(obs["force_field_N"].sum((1, 2)), (force.sum(2) * inside[..., None]).sum(1), atol=1e-5)
            assert obs["press_force_N"][-1] > 0.01
            pose = np.load(press + "/object_pose.npy")[frames]
            x, y, z, w = obs["object_pose"][:, 3:].T
            assert (w >= 0).all() and np.allclose(x * x + y * y + z * z + w * w, 1, atol=1e-6)
            turned = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)], -1)
            assert np.allclose(turned, pose[:, :3, 0], atol=1e-6)  # where the object's x axis points
            assert np.allclose(obs["object_pose"][:, :3], 1e3 * pose[:, :3, 3], atol=1e-5)
            assert np.allclose(obs["marker_mm"], 1e3 * np.load(press + "/markers.npy")[frames], atol=1e-5)
            assert (obs["phase"] == np.load(press + "/phase.npy")[frames]).all()
            assert (obs["time_s"] == np.load(press + "/time.npy")[frames]).all()
            for i, frame in enumerate(frames):
                folder = f"{render}/frame_{frame:04}/"
                assert (obs["rgb"][i] == picture(folder + "tactile.png")).all()
                assert (obs["contact_mask"][i] == (picture(folder + "contact.png") == 255)).all()
                assert (127 * obs["slip_state"][i].astype(int) == picture(folder + "stick_slip.png")).all()
                assert (sample["variants/white/rgb"][i] == picture(folder + "white/tactile.png")).all()
            seen = np.isfinite(obs["marker_px"][:, 1]).all(-1)
            assert (seen == (obs["marker_visible"] == 1)).all() and seen.any()
            # Images, markers and frame S agree: the rectified camera sees each marker of frame 0 where its map says.
            camera = f["sensors"][sample.attrs["sensor_id"]].attrs
            px = np.concatenate([obs["marker_px"][0, 0], np.ones((seen.shape[1], 1))], 1)
            plane = px @ camera["plane_from_pixel"].T
            assert np.allclose(plane[seen[0], :2], obs["marker_mm"][0][seen[0], :2], atol=1e-3)
            assert obs["indentation_mm"][0].max() < 0.01 < obs["indentation_mm"][-1].max()
            assert set(sample["variants/white"]) == {"rgb", "rgb_marker"}
            assert "absent_normal" in sample["variants/white"].attrs
            checked += 1
assert checked == sum(row["status"] == "made" for row in manifest.values()) > 0

ids = {name: open(os.path.join(pack, f"splits/{name}.txt")).read().split() for name in ("train", "val", "test")}
assert {s: row["split"] for s, row in manifest.items() if row["status"] == "made"} == {s: n for n in ids for s in ids[n]}
failures = list(csv.DictReader(open(os.path.join(pack, "failures.csv"))))
assert [row["id"] for row in failures] == [s for s, row in manifest.items() if row["status"] != "made"]
assert all(row["reason"] for row in failures)

# The ten lines of the card, of the documentation and of configs/datasets/card are the same, and load batches.
loader = open(os.path.join(source, "configs/datasets/card/loader.py")).read()
assert loader in open(os.path.join(pack, "README.md")).read() and loader in open(os.path.join(source, "docs/pack.md")).read()
code = {}
exec(loader, code)
frames = code["Tactile"](os.path.join(pack, "shards/*.h5"))
assert len(frames) == sum(int(row["n_frames"] or 0) for row in manifest.values())
for batch in torch.utils.data.DataLoader(frames, batch_size=3, num_workers=1):
    assert batch["rgb"].dtype == torch.uint8 and batch["rgb"].shape[-1] == 3
    assert batch["force_N"].shape[-1] == 3 and batch["indentation_mm"].dtype == torch.float32
camera = json.load(open(glob.glob(os.path.join(pack, "sensors/*/camera.json"))[0]))
assert len(camera["T_S_camera"]) == 4
print(f"{checked} samples hold")
