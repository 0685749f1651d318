"""Deviations of a packed dataset against those of the presses that it was made of. check_ensemble.py DATASET MEMBERS [ID=MEMBER …]

ID=MEMBER … are presses that must be missing, all others of MEMBERS members there; m01 alone is on a mount that gives way."""
import glob
import os
import sys

import h5py
import numpy as np

dataset, count = sys.argv[1], int(sys.argv[2])
missing = dict(word.split("=") for word in sys.argv[3:])


def arrays(folder):
    wrench, x = (np.load(os.path.join(folder, name + ".npy")) for name in ("wrench", "positions"))
    front = np.load(os.path.join(folder, "front_vertices.npy"))
    sunk = x[0][None, front, 2] - x[:, front, 2]
    return {"press_force_N": -wrench[:, 2], "tangential_force_N": np.hypot(wrench[:, 0], wrench[:, 1]),
            "torque_Nmm": 1e3 * wrench[:, 3:], "deepest_indentation_mm": 1e3 * np.maximum(sunk.max(axis=1), 0.0)}


samples = 0
for path in sorted(glob.glob(os.path.join(dataset, "pack/shards/*.h5"))):
    with h5py.File(path) as f:
        for name, sample in f["data"].items():
            found = sample["ensemble"]
            folder = glob.glob(os.path.join(dataset, "samples/*", name))[0]
            members = found.attrs["members"].split()
            assert len(members) == found.attrs["num_members"] == count - (name in missing), (name, members)
            assert found.attrs["missing"] == missing.get(name, ""), found.attrs["missing"]
            own = arrays(os.path.join(folder, "press"))
            coarse = arrays(os.path.join(folder, "ensemble/nominal/press"))
            of = [arrays(os.path.join(folder, "ensemble", member, "press")) for member in members]
            frames = sample["obs/frame"][:]
            for label, values in own.items():
                np.testing.assert_allclose(found[label][:], values[frames], rtol=1e-6, atol=1e-9)
                np.testing.assert_allclose(found[label + "_mesh"][:], (coarse[label] - values)[frames], rtol=1e-5, atol=1e-7)
                if len(of) < 2:
                    assert label + "_sigma" not in found
                    assert found.attrs["absent_" + label + "_sigma"] == "fewer than two members were pressed"
                    continue
                spread = np.std([one[label] for one in of], axis=0, ddof=1)[frames]
                np.testing.assert_allclose(found[label + "_sigma"][:], spread, rtol=1e-5, atol=1e-7)
                assert label != "press_force_N" or spread[-1] > 1e-3
            assert "contact_area_mm2" in found
            # Only a mount that gives way lets objects go less far than they are moved, all turned alike.
            holds = [os.path.exists(os.path.join(folder, "ensemble", member, "press/holder_pose.npy")) for member in members]
            if any(holds):
                z = [np.load(os.path.join(folder, "ensemble", m, "press/object_pose.npy"))[frames, 2, 3] for m in members]
                np.testing.assert_allclose(found["object_depth_mm_sigma"][:], 1e3 * np.std(z, axis=0, ddof=1), rtol=1e-4, atol=1e-7)
                assert found["object_depth_mm_sigma"][-1] > 1e-3 and holds == [False, True]
            else:
                assert found.attrs["absent_object_depth_mm"] == "the mounts are rigid"
            samples += 1
assert samples == 2, samples
