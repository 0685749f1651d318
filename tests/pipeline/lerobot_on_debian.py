"""Lets Debian 12's Python 3.11, PyTorch 1.13 and torchvision 0.14 import lerobot 0.6, which asks for 3.12, 2.7 and 0.22.

Five of lerobot's modules declare generics as Python 3.12 does; they are rewritten to the older form as they are loaded. Of
newer libraries its modules name a class of schedulers and the image augmentations, which the tests do not use; these names
are added. All else is lerobot's own code, as it is. With Python 3.12 and newer this module does nothing."""
import importlib.abc, importlib.machinery, re, sys, types


def older(source):
    """Python 3.12's `type N = …`, `class N[T](…)` and `def n[T](…)` in the words of Python 3.11."""
    def names(parameters):
        return [p.split(":")[0].strip() for p in parameters.split(",")]

    def variables(parameters):
        return "".join(f'{n} = __import__("typing").TypeVar("{n}")\n' for n in names(parameters))

    def generic(match):
        before, name, parameters, bases = match.groups()
        bases = ", ".join(filter(None, [bases, f'__import__("typing").Generic[{", ".join(names(parameters))}]']))
        return f"{variables(parameters)}{before}class {name}({bases}):"

    source = re.sub(r"(?m)^type (\w+) = ", r"\1 = ", source)
    source = re.sub(r"(?m)^((?:@.*\n)*)class (\w+)\[([^\]]*)\](?:\((.*)\))?:", generic, source)
    return re.sub(r"(?m)^((?:@.*\n)*)def (\w+)\[([^\]]*)\]\(", lambda m: f"{variables(m[3])}{m[1]}def {m[2]}(", source)


class OlderLoader(importlib.machinery.SourceFileLoader):
    def source_to_code(self, data, path):
        return super().source_to_code(older(data.decode()).encode(), path)


class OlderFinder(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name.split(".")[0] != "lerobot":
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, path, target)
        if spec and isinstance(spec.loader, importlib.machinery.SourceFileLoader):
            spec.loader = OlderLoader(spec.loader.name, spec.loader.path)
        return spec


class NamesOnly(types.ModuleType):
    """A module in which every name is an empty class."""

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return type(name, (), {})


if sys.version_info < (3, 12):
    import torch, torchvision.transforms

    sys.meta_path.insert(0, OlderFinder())
    if not hasattr(torch.optim.lr_scheduler, "LRScheduler"):
        torch.optim.lr_scheduler.LRScheduler = torch.optim.lr_scheduler._LRScheduler
    if not hasattr(torchvision.transforms, "v2"):
        v2 = sys.modules["torchvision.transforms.v2"] = torchvision.transforms.v2 = NamesOnly("torchvision.transforms.v2")
        v2.__path__ = []
        v2.functional = sys.modules["torchvision.transforms.v2.functional"] = NamesOnly("torchvision.transforms.v2.functional")
