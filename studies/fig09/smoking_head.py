"""How deep the smoke stands over the head of the dense flow, measured in the frames of one run (needs numpy, h5py).

Definition
----------
All depths are vertical [m]; heights are counted from the snow surface of the first frame (the topmost cover particle
of each strip), so that slope and bumps drop out. Ways s [m] are measured along that surface.

* front: the s below which 99 % of the dense flow's mass lies.
* head: the 20 m behind the front, in strips of 1 m. A strip counts if it holds at least two dense particles and lies
  inside the grid.
* flow depth of a strip: from its lowest to its highest dense particle, plus one particle spacing. Snow that was thrown
  up into the cloud counts as flow, which is on the safe side.
* cloud depth of a strip: from its lowest dense particle to the top of its highest grid cell with more than 0.1 kg/m3 of
  smoke; 0 where there is none.
* head ratio: mean cloud depth over mean flow depth, both over the strips of the head.
* smoking head: the head ratio is at least 2.

A run is told by two numbers, both from its frames after 2 s (the start-up, in which the slab only begins to move):
the median of the head ratio, and the share of frames with a smoking head.
"""
import glob
import os

import h5py
import numpy as np

CLOUD_DENSITY = 0.1  # [kg/m3]
HEAD_LENGTH = 20.0   # [m]
STRIP = 1.0          # [m]
START_UP = 2.0       # [s]
DENSE, COVER = 0, 1  # values of the field "layer"


def read_particles(path):
    """Time [s], places (n, 2) as x and z [m], masses [kg] and layers of one particle frame."""
    with h5py.File(path) as file:
        points = file["VTKHDF/Points"][:][:, [0, 2]].astype(float)
        data = file["VTKHDF/PointData"]
        return float(file["spindrift"].attrs["time"]), points, data["mass"][:].astype(float), data["layer"][:]


def read_cloud_top(path):
    """Centres x [m] of the grid's columns, and the top z [m] of the cloud in each (-inf: none)."""
    with h5py.File(path) as file:
        image = file["VTKHDF"]
        density = image["PointData/density"][:, 0, :]
        origin, spacing = image.attrs["Origin"], image.attrs["Spacing"]
    cloud = density > CLOUD_DENSITY
    highest = density.shape[0] - 1 - np.argmax(cloud[::-1], axis=0)
    top = origin[2] + (highest + 0.5) * spacing[2]
    x = origin[0] + np.arange(density.shape[1]) * spacing[0]
    return x, np.where(cloud.any(axis=0), top, -np.inf)


class Surface:
    """The snow surface of the first frame: z(x) [m], and the way s(x) along it [m]."""

    def __init__(self, points, layers, spacing):
        cover = points[layers == COVER]
        strip = (cover[:, 0] / (2 * spacing)).astype(int)
        top = np.full(strip.max() + 1, -np.inf)
        np.maximum.at(top, strip, cover[:, 1])
        found = np.isfinite(top)
        self.x = (np.nonzero(found)[0] + 0.5) * 2 * spacing
        self.z = top[found]
        steps = np.hypot(np.diff(self.x), np.diff(self.z))
        self.s = np.concatenate([[0.0], np.cumsum(steps)])

    def way(self, x):
        """Way along the surface [m] at x [m]."""
        return np.interp(x, self.x, self.s)

    def height(self, x, z):
        """Height above the surface [m]."""
        return z - np.interp(x, self.x, self.z)


def percentile_by_mass(s, mass, share):
    """The way [m] below which this share of the mass lies."""
    order = np.argsort(s)
    total = np.cumsum(mass[order])
    return s[order][np.searchsorted(total, share * total[-1])]


def head_depths(surface, points, mass, x_cloud, z_cloud, spacing):
    """Front [m], mean flow depth [m] and mean cloud depth [m] of the head."""
    s, height = surface.way(points[:, 0]), surface.height(points[:, 0], points[:, 1])
    front = percentile_by_mass(s, mass, 0.99)
    s_cloud, h_cloud = surface.way(x_cloud), surface.height(x_cloud, z_cloud)
    flow, cloud = [], []
    for upper in front - STRIP * np.arange(int(HEAD_LENGTH / STRIP)):
        inside = (s > upper - STRIP) & (s <= upper)
        above = (s_cloud > upper - STRIP) & (s_cloud <= upper)
        if inside.sum() < 2 or not above.any():
            continue
        base = height[inside].min() - spacing / 2
        flow.append(height[inside].max() + spacing / 2 - base)
        cloud.append(max(0.0, h_cloud[above].max() - base))
    return front, float(np.mean(flow)), float(np.mean(cloud))


def measure(run_folder, spacing=0.105):
    """Rows (time [s], front [m], flow depth [m], cloud depth [m], ratio) of the frames of a run, the first left out."""
    frames = sorted(glob.glob(os.path.join(run_folder, "frames", "particles_*.hdf")))
    _, points, _, layers = read_particles(frames[0])
    surface = Surface(points, layers, spacing)
    rows = []
    for path in frames[1:]:
        time, points, mass, layers = read_particles(path)
        dense = layers == DENSE
        x_cloud, z_cloud = read_cloud_top(path.replace("particles_", "smoke_"))
        front, flow, cloud = head_depths(surface, points[dense], mass[dense], x_cloud, z_cloud, spacing)
        rows.append((time, front, flow, cloud, cloud / flow))
    return rows


def summary(rows, until=float("inf")):
    """Median head ratio and share of frames with a smoking head, after the start-up and up to a time [s]."""
    ratios = [row[4] for row in rows if START_UP < row[0] <= until]
    if not ratios:
        return float("nan"), float("nan")
    return float(np.median(ratios)), float(np.mean(np.array(ratios) >= 2))
