! Every procedure of a context, of each kind, tells what is wrong by stat and errmsg, and leaves its arguments as they
! were: here there is no context.
module without_context_tests
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32, real64
  use test_expect
  use tetlod
  implicit none
  integer :: stat = -1
  character(len=60) :: message = ""
  type(tetlod_context) :: none

contains

  ! Of the call before, and makes ready for the next.
  subroutine told(what)
    character(len=*), intent(in) :: what
    call expect(stat == TETLOD_ERR_ARGUMENT, what//" sets stat")
    call expect(index(message, "there is no context") == 1, what//" sets errmsg: "//message)
    stat = -1
    message = ""
  end subroutine

  subroutine test_settings()
    real(real32) :: r32
    real(real64) :: r64
    integer(int32) :: i32
    integer(int64) :: i64
    call none%set_rho(0.5, stat, message); call told("set_rho of real32")
    call none%set_rho(0.5d0, stat, message); call told("set_rho of real64")
    call none%set_sigma(0.5, stat, message); call told("set_sigma of real32")
    call none%set_sigma(0.5d0, stat, message); call told("set_sigma of real64")
    call none%set_lambda(0.5, stat, message); call told("set_lambda of real32")
    call none%set_lambda(0.5d0, stat, message); call told("set_lambda of real64")
    call none%set_min_distance(0.5, stat, message); call told("set_min_distance of real32")
    call none%set_min_distance(0.5d0, stat, message); call told("set_min_distance of real64")
    call none%set_preset(TETLOD_PRESET_FAST, stat, message); call told("set_preset")
    call none%set_real(TETLOD_OPT_RHO, 0.5, stat, message); call told("set_real of real32")
    call none%set_real(TETLOD_OPT_RHO, 0.5d0, stat, message); call told("set_real of real64")
    call none%set_int(TETLOD_OPT_SEED, 1_int32, stat, message); call told("set_int of int32")
    call none%set_int(TETLOD_OPT_SEED, 1_int64, stat, message); call told("set_int of int64")
    r32 = 7; r64 = 7; i32 = 7; i64 = 7
    call none%get_real(TETLOD_OPT_RHO, r32, stat, message); call told("get_real of real32")
    call none%get_real(TETLOD_OPT_RHO, r64, stat, message); call told("get_real of real64")
    call none%get_int(TETLOD_OPT_SEED, i32, stat, message); call told("get_int of int32")
    call none%get_int(TETLOD_OPT_SEED, i64, stat, message); call told("get_int of int64")
    call expect(nint(r32) == 7 .and. nint(r64) == 7 .and. i32 == 7 .and. i64 == 7, "values are left alone")
  end subroutine

  subroutine test_callbacks()
    call none%set_log(stat=stat, errmsg=message); call told("set_log")
    call none%set_progress(stat=stat, errmsg=message); call told("set_progress")
    call none%cancel()
    call expect(none%last_message() /= "", "the last message is the thread's")
  end subroutine

  subroutine test_submission()
    real(real32), target :: r32(3, 2)
    real(real64), target :: r64(3, 2)
    integer(int8), target :: i8(4, 2)
    integer(int32), target :: i32(4, 2)
    integer(int64), target :: i64(4, 2)
    type(tetlod_mesh_report) :: report
    integer(int64) :: bytes
    r32 = 0; r64 = 0; i8 = 0_int8; i32 = 1; i64 = 1
    call none%submit_points(r32, stat, message); call told("submit_points of real32")
    call none%submit_points(r64, stat, message); call told("submit_points of real64")
    call none%submit_points_xyz(r32(1, :), r32(2, :), r32(3, :), stat, message)
    call told("submit_points_xyz of real32")
    call none%submit_points_xyz(r64(1, :), r64(2, :), r64(3, :), stat, message)
    call told("submit_points_xyz of real64")
    call none%submit_tets(i32, 1, stat, message); call told("submit_tets of int32")
    call none%submit_tets(i64, 1, stat, message); call told("submit_tets of int64")
    call none%submit_scalars("s", r32(1, :), stat, message); call told("submit_scalars of real32")
    call none%submit_scalars("s", r64(1, :), stat, message); call told("submit_scalars of real64")
    call none%submit_field("f", TETLOD_POINT_FIELD, r32, stat, message); call told("submit_field of real32")
    call none%submit_field("f", TETLOD_POINT_FIELD, r64, stat, message); call told("submit_field of real64")
    call none%submit_field("f", TETLOD_POINT_FIELD, i8, stat, message); call told("submit_field of int8")
    call none%submit_field("f", TETLOD_POINT_FIELD, i32, stat, message); call told("submit_field of int32")
    call none%submit_field("f", TETLOD_POINT_FIELD, i64, stat, message); call told("submit_field of int64")
    call none%submit_steering("s", 1d0, r32(1, :), stat, message); call told("submit_steering of real32")
    call none%submit_steering("s", 1d0, r64(1, :), stat, message); call told("submit_steering of real64")
    call none%withdraw_field("f", stat, message); call told("withdraw_field")
    call none%submit_point_flags(i8(1, :), stat, message); call told("submit_point_flags")
    call none%clear(stat, message); call told("clear")
    report%tets = 7; bytes = 7
    call none%check(report, stat, message); call told("check")
    call none%estimate_memory(bytes, stat, message); call told("estimate_memory")
    call expect(report%tets == 7 .and. bytes == 7, "reports are left alone")
  end subroutine

  subroutine test_run()
    type(tetlod_error_report) :: error
    type(tetlod_run_report) :: report
    integer(int64), allocatable :: counts(:)
    integer(int32) :: n = 7, m = 7, k = 7
    integer(int64) :: wide(3) = 7
    call none%run(stat, message); call told("run")
    error%max = 7; report%tets_out = 7
    call none%measure_error(1, error, stat, message); call told("measure_error")
    call none%histogram(0, 5, counts, stat, message); call told("histogram")
    call none%fetch_report(report, stat, message); call told("fetch_report")
    call none%fetch_counts(n, m, k, stat, message); call told("fetch_counts of int32")
    call none%fetch_counts(wide(1), wide(2), wide(3), stat, message); call told("fetch_counts of int64")
    call expect(nint(error%max) == 7 .and. report%tets_out == 7, "reports of a run are left alone")
    call expect(.not. allocated(counts) .and. all([n, m, k] == 7) .and. all(wide == 7), "counts are left alone")
  end subroutine

  subroutine test_fetching()
    real(real32), allocatable :: r32_values(:), r32_points(:, :)
    real(real64), allocatable :: r64_values(:), r64_points(:, :)
    integer(int32), allocatable :: i32_tets(:, :), i32_faces(:, :)
    integer(int64), allocatable :: i64_tets(:, :), i64_faces(:, :)
    call none%fetch_points(r32_points, stat, message); call told("fetch_points of real32")
    call none%fetch_points(r64_points, stat, message); call told("fetch_points of real64")
    call none%fetch_tets(i32_tets, 1, stat, message); call told("fetch_tets of int32")
    call none%fetch_tets(i64_tets, 1, stat, message); call told("fetch_tets of int64")
    call none%fetch_boundary(i32_faces, 1, stat, message); call told("fetch_boundary of int32")
    call none%fetch_boundary(i64_faces, 1, stat, message); call told("fetch_boundary of int64")
    call none%fetch_scalars(r32_values, stat, message); call told("fetch_scalars of real32")
    call none%fetch_scalars(r64_values, stat, message); call told("fetch_scalars of real64")
    call expect(.not. (allocated(r32_points) .or. allocated(r64_points) .or. allocated(i32_tets) .or. &
                       allocated(i64_tets) .or. allocated(i32_faces) .or. allocated(i64_faces) .or. &
                       allocated(r32_values) .or. allocated(r64_values)), "nothing is allocated")
  end subroutine

  subroutine test_views()
    real(real64), target :: points(3, 1), values(1)
    integer(int32), target :: tets(4, 1)
    real(real64), pointer :: seen_points(:, :), seen_values(:)
    integer(int32), pointer :: seen_tets(:, :)
    points = 0; values = 0; tets = 0
    seen_points => points; seen_values => values; seen_tets => tets
    call none%view_points(seen_points, stat, message); call told("view_points")
    call none%view_tets(seen_tets, stat, message); call told("view_tets")
    call none%view_scalars(seen_values, stat, message); call told("view_scalars")
    call expect(.not. (associated(seen_points) .or. associated(seen_tets) .or. associated(seen_values)), "no view")
  end subroutine

  subroutine test_fields()
    real(real32), target :: r32(4, 2)
    real(real64), target :: r64(4, 2)
    integer(int8), target :: i8(4, 2)
    integer(int32), target :: i32(4, 2)
    integer(int64), target :: i64(4, 2)
    r32 = 7; r64 = 7; i8 = 7_int8; i32 = 7; i64 = 7
    call none%fetch_field("f", r32, stat, message); call told("fetch_field of real32")
    call none%fetch_field("f", r64, stat, message); call told("fetch_field of real64")
    call none%fetch_field("f", i8, stat, message); call told("fetch_field of int8")
    call none%fetch_field("f", i32, stat, message); call told("fetch_field of int32")
    call none%fetch_field("f", i64, stat, message); call told("fetch_field of int64")
    call none%fetch_stencil(i32, r64, 1, stat, message); call told("fetch_stencil of int32")
    call none%fetch_stencil(i64, r64, 1, stat, message); call told("fetch_stencil of int64")
    call none%transfer(r32(:, 1:1), r32(:, 2:2), stat, message); call told("transfer of real32")
    call none%transfer(r64(:, 1:1), r64(:, 2:2), stat, message); call told("transfer of real64")
    call none%transfer(i8(:, 1:1), i8(:, 2:2), stat, message); call told("transfer of int8")
    call none%transfer(i32(:, 1:1), i32(:, 2:2), stat, message); call told("transfer of int32")
    call none%transfer(i64(:, 1:1), i64(:, 2:2), stat, message); call told("transfer of int64")
    call expect(all(nint(r32) == 7) .and. all(nint(r64) == 7) .and. all(i8 == 7_int8) .and. all(i32 == 7) .and. &
                all(i64 == 7), "fields are left alone")
  end subroutine

  ! Also what needs no context; a short errmsg gets the beginning.
  subroutine test_bounds()
    type(tetlod_bounds) :: bounds
    character(len=13) :: beginning
    beginning = ""
    call tetlod_option_bounds(-1, bounds, stat, beginning)
    call expect(stat == TETLOD_ERR_OPTION .and. beginning == "option_bounds", "bounds of nothing: "//beginning)
  end subroutine
end module

program test_without_context
  use without_context_tests
  implicit none
  call test_settings()
  call test_callbacks()
  call test_submission()
  call test_run()
  call test_fetching()
  call test_views()
  call test_fields()
  call test_bounds()
  if (failures > 0) error stop "failures of the module tetlod are not told"
  print '("ok")'
end program
