from os import PathLike
from types import TracebackType
from typing import Any, Callable, Iterable, NamedTuple, Optional, Sequence, Tuple, Type, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

Paths = Union[str, bytes, PathLike[str], Iterable[Union[str, bytes, PathLike[str]]]]
Progress = Callable[[float, str], object]
PointLike = Union["Point", Sequence[float]]
Air = Union[str, float]

AIR_STANDARD: str
UNKNOWN: np.float32

class Error(Exception):
    code: int

class UsageError(Error, ValueError): ...
class NoDataError(Error): ...
class NoDeviceError(Error): ...
class CancelledError(Error): ...

class Point(NamedTuple):
    lat_deg: float
    lon_deg: float
    height_m: float = ...
    above: str = ...

class Position(NamedTuple):
    lat_deg: float
    lon_deg: float
    H_m: float
    h_m: float

class Sight(NamedTuple):
    visible: bool
    from_: Position
    to: Position
    obstacle: Optional[Position]
    obstacle_distance_m: float
    target_deficit_m: float
    eye_deficit_m: float
    least_clearance_m: float
    least_clearance: Position
    distance_m: float
    azimuth_deg: float
    elevation_deg: float
    slant_m: float
    without_data_m: float

class Profile(NamedTuple):
    points: NDArray[np.void]
    length_m: float
    ascent_m: float
    descent_m: float
    ascent_over_m: float
    descent_over_m: float
    without_data_m: float
    highest: int
    lowest: int

class Viewshed(NamedTuple):
    clearance_deficit_m: NDArray[np.float32]
    observers: NDArray[np.float32]
    transform: Tuple[float, float, float, float, float, float]
    crs: str
    known: int
    seen: int

class Horizons(NamedTuple):
    elevation_deg: NDArray[np.float32]
    sky_view: NDArray[np.float32]
    transform: Tuple[float, float, float, float, float, float]
    crs: str
    known: int
    with_sky_view: int

class Region:
    def __enter__(self) -> "Region": ...
    def __exit__(self, kind: Optional[Type[BaseException]], value: Optional[BaseException],
                 trace: Optional[TracebackType]) -> None: ...
    def close(self) -> None: ...
    @property
    def info(self) -> dict[str, Any]: ...
    def heights(self, lat_deg: ArrayLike, lon_deg: ArrayLike, *,
                progress: Optional[Progress] = ...) -> Tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def sight(self, from_: PointLike, to: PointLike, *, air: Air = ..., on_summit: bool = ...) -> Sight: ...
    def profile(self, lat_deg: ArrayLike, lon_deg: ArrayLike, *, step_m: Optional[float] = ...,
                climb_threshold_m: float = ..., progress: Optional[Progress] = ...) -> Profile: ...
    def viewshed(self, eyes: Union[PointLike, Sequence[PointLike]], *, radius_km: float = ..., target_m: float = ...,
                 air: Air = ..., on_summit: bool = ..., targets_on_canopy: bool = ...,
                 out: Optional[Tuple[NDArray[np.float32], NDArray[np.float32]]] = ...,
                 progress: Optional[Progress] = ...) -> Viewshed: ...
    def viewshed_shape(self, eyes: Union[PointLike, Sequence[PointLike]], *, radius_km: float = ...,
                       target_m: float = ..., air: Air = ..., on_summit: bool = ...,
                       targets_on_canopy: bool = ...) -> Tuple[int, int]: ...
    def horizon(self, *, bbox: Optional[Union[str, Sequence[float]]] = ..., directions: int = ...,
                radius_km: float = ..., above_m: float = ..., air: Air = ...,
                out: Optional[Tuple[NDArray[np.float32], NDArray[np.float32]]] = ...,
                progress: Optional[Progress] = ...) -> Horizons: ...
    def shot(self, *words: object, progress: Optional[Progress] = ..., out: Optional[NDArray[np.uint8]] = ...,
             **options: object) -> NDArray[np.uint8]: ...
    def layers(self, *words: object, names: Sequence[str] = ..., progress: Optional[Progress] = ...,
               **options: object) -> dict[str, NDArray[Any]]: ...
    def panorama(self, *words: object, progress: Optional[Progress] = ..., out: Optional[NDArray[np.uint8]] = ...,
                 **options: object) -> NDArray[np.uint8]: ...

def open(paths: Paths, *, bbox: Optional[Union[str, Sequence[float]]] = ..., tile: Optional[str] = ...,
         height_unit: Optional[str] = ..., source_crs: Optional[str] = ..., source_vertical: Optional[str] = ...,
         order: Optional[str] = ..., feather_m: float = ..., strict_datum: bool = ..., fill_voids: bool = ...,
         resample: bool = ..., landcover: Paths = ..., canopy: Paths = ..., canopy_held: Optional[float] = ...,
         progress: Optional[Progress] = ...) -> Region: ...
def version() -> str: ...
