import glob, h5py, torch

class Tactile(torch.utils.data.Dataset):
    def __init__(self, shards, keys=("rgb", "indentation_mm", "force_N")):
        self.keys, self.frames = keys, []
        for path in sorted(glob.glob(shards)):
            with h5py.File(path) as f:
                self.frames += [(path, s, t) for s in f["data"] for t in range(f["data"][s].attrs["n_frames"])]
    def __len__(self): return len(self.frames)
    def __getitem__(self, n):
        path, s, t = self.frames[n]
        with h5py.File(path) as f: return {k: torch.as_tensor(f[f"data/{s}/obs/{k}"][t]) for k in self.keys}
