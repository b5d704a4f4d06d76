! The numbers and structs of tetlod.h, under its names. A ctest compares both files, so that whatever is added there
! is added here.
module tetlod_types
  use, intrinsic :: iso_c_binding, only: c_double, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, c_ptr
  implicit none
  private

  integer(c_int32_t), parameter, public :: TETLOD_VERSION_MAJOR = 0_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_VERSION_MINOR = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_VERSION_PATCH = 0_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_API_VERSION = &
    TETLOD_VERSION_MAJOR * 10000_c_int32_t + TETLOD_VERSION_MINOR * 100_c_int32_t + TETLOD_VERSION_PATCH
  integer(c_int32_t), parameter, public :: TETLOD_OK = 0_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_INTERNAL = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_ARGUMENT = 10_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_OPTION = 11_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_STATE = 12_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_STRUCT_SIZE = 13_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_BUFFER_SIZE = 14_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MEMORY = 20_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MEMORY_LIMIT = 21_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_CANCELLED = 22_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_TIME_LIMIT = 23_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_EMPTY = 30_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_INDEX = 31_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_NONFINITE = 32_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_DEGENERATE = 33_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_NONMANIFOLD = 34_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_INTERSECTING = 35_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_PARTITION = 36_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MESH_TOO_LARGE = 37_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_REMESH = 40_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_BACKEND_MISSING = 41_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_ERR_MAX_ERROR = 42_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_INT32 = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_INT64 = 2_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_FLOAT32 = 3_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_FLOAT64 = 4_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_UINT8 = 5_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_POINT_FIELD = 0_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_CELL_FIELD = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_FLAG_KEEP = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_FLAG_LOCK = 2_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_PRESET_PAPER = 0_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_PRESET_FAST = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_PRESET_ACCURATE = 2_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_RHO = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_SIGMA = 2_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_LAMBDA = 3_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_MIN_DISTANCE = 4_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_MERGE_TOLERANCE = 5_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_CLEAN_EDGES = 6_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_BOUNDARY_LEAF = 7_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_TET_LEAF = 8_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_THREADS = 9_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_SEED = 10_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_TIME_LIMIT = 11_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_COINCIDENT = 12_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_REPEATED = 13_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_FLAT = 14_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_INVERTED = 15_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_DUPLICATE = 16_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_OVERLAP = 17_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_UNUSED = 18_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_ON_NONFINITE = 19_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_TARGET_RATIO = 20_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_EFFORT = 21_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_MAX_ERROR = 22_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_MAX_DEVIATION = 23_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_WARM_START = 24_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_OPT_REMESH = 25_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_EFFORT_FAST = 1_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_EFFORT_ACCURATE = 2_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_POLICY_ERROR = 0_c_int32_t
  integer(c_int32_t), parameter, public :: TETLOD_POLICY_REPAIR = 1_c_int32_t

  ! An array as the C ABI takes it; module tetlod_arrays makes them of Fortran arrays.
  type, bind(C), public :: tetlod_array
    integer(c_int32_t) :: struct_size = 0, type = 0
    integer(c_int64_t) :: tuples = 0
    integer(c_int32_t) :: components = 0, reserved = 0
    integer(c_int64_t) :: tuple_stride = 0, component_stride = 0
    type(c_ptr) :: data = c_null_ptr
  end type

  type, bind(C), public :: tetlod_config
    integer(c_int32_t) :: struct_size = 0, api_version = 0
    type(c_funptr) :: allocate = c_null_funptr, release = c_null_funptr
    type(c_ptr) :: allocator_user = c_null_ptr
    integer(c_int64_t) :: memory_limit = 0
    type(c_ptr) :: remesher = c_null_ptr
  end type

  ! What the last successful run did. Seconds are wall-clock; bytes and hash are the bits of unsigned numbers.
  type, bind(C), public :: tetlod_run_report
    integer(c_int32_t) :: struct_size = 0, threads = 0
    integer(c_int64_t) :: points_in = 0, tets_in = 0
    integer(c_int64_t) :: merged_points = 0
    integer(c_int64_t) :: nonfinite_points = 0
    integer(c_int64_t) :: dropped_tets = 0
    integer(c_int64_t) :: unused_points = 0
    integer(c_int64_t) :: interior_points_in = 0
    integer(c_int64_t) :: boundary_points_in = 0, boundary_edges_in = 0, boundary_triangles_in = 0
    integer(c_int64_t) :: components = 0
    integer(c_int64_t) :: nonmanifold_edges = 0, nonmanifold_points = 0
    integer(c_int64_t) :: cleaned_edges = 0
    integer(c_int64_t) :: boundary_points_out = 0, boundary_edges_out = 0, boundary_triangles_out = 0
    integer(c_int64_t) :: selected_samples = 0
    integer(c_int64_t) :: samples_outside = 0, samples_too_near = 0
    integer(c_int64_t) :: samples = 0
    integer(c_int64_t) :: steiner_points = 0
    integer(c_int64_t) :: points_out = 0, tets_out = 0
    integer(c_int64_t) :: remesh_attempts = 0
    integer(c_int64_t) :: boundary_retries = 0
    real(c_double) :: seconds_prepare = 0, seconds_boundary = 0, seconds_decimate = 0, seconds_sample = 0
    real(c_double) :: seconds_cull = 0, seconds_remesh = 0, seconds_values = 0, seconds_total = 0
    integer(c_int64_t) :: peak_bytes = 0
    integer(c_int64_t) :: worker_peak_bytes = 0
    integer(c_int64_t) :: hash = 0
    real(c_double) :: scalar_min = 0, scalar_max = 0
    integer(c_int64_t) :: inserted_points = 0
    real(c_double) :: max_error = 0
    real(c_double) :: max_deviation = 0
    integer(c_int64_t) :: reused_tets = 0
    integer(c_int64_t) :: reused_triangles = 0
    integer(c_int64_t) :: reused_samples = 0
    integer(c_int64_t) :: reused_collapses = 0
    integer(c_int64_t) :: divided_tets = 0
    integer(c_int64_t) :: moved_points = 0
  end type

  ! The field error of the last result, relative to the range of the original's values.
  type, bind(C), public :: tetlod_error_report
    integer(c_int32_t) :: struct_size = 0, samples_per_tet = 0
    real(c_double) :: rms = 0, max = 0
    real(c_double) :: outside = 0
    real(c_double) :: rms_inner = 0, max_inner = 0
    real(c_double) :: outside_inner = 0
  end type

  ! How many, and the first culprit, numbered from the index base of the submitted tets; -1 when there is none.
  type, bind(C), public :: tetlod_defect
    integer(c_int64_t) :: count = 0, first = 0
  end type

  type, bind(C), public :: tetlod_mesh_report
    integer(c_int32_t) :: struct_size = 0
    integer(c_int32_t) :: status = 0
    integer(c_int64_t) :: points = 0, tets = 0
    integer(c_int64_t) :: boundary_triangles = 0
    integer(c_int64_t) :: components = 0
    type(tetlod_defect) :: index
    type(tetlod_defect) :: repeated
    type(tetlod_defect) :: nonfinite_points
    type(tetlod_defect) :: nonfinite_values
    type(tetlod_defect) :: coincident
    type(tetlod_defect) :: flat
    type(tetlod_defect) :: inverted
    type(tetlod_defect) :: duplicate
    type(tetlod_defect) :: nonmanifold_faces
    type(tetlod_defect) :: overlapping
    type(tetlod_defect) :: unused
    type(tetlod_defect) :: nonmanifold_edges
    type(tetlod_defect) :: nonmanifold_points
  end type

  type, bind(C), public :: tetlod_bounds
    integer(c_int32_t) :: struct_size = 0, is_integer = 0
    real(c_double) :: least = 0, most = 0, preset = 0
  end type
end module
