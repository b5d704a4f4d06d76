! The run and its result. Fetched arrays are copies of their own; they are not allocated after a failure. Other output
! arguments keep their values then. Indices count from 1 unless index_base says otherwise.
module tetlod_results
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int32_t, c_int64_t, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use tetlod_arrays, only: array_of, empty_array
  use tetlod_c
  use tetlod_lifetime, only: conclude
  use tetlod_fields_of_result, only: tetlod_fields
  use tetlod_types, only: tetlod_array, tetlod_error_report, tetlod_run_report, TETLOD_ERR_MEMORY, TETLOD_OK
  implicit none
  private

  integer, parameter :: most_bins = 2**20  ! of a histogram

  type, extends(tetlod_fields), public :: tetlod_context
  contains
    procedure :: run
    procedure :: measure_error
    procedure :: histogram
    generic :: fetch_counts => fetch_counts_i32, fetch_counts_i64
    generic :: fetch_points => fetch_points_r32, fetch_points_r64
    generic :: fetch_tets => fetch_tets_i32, fetch_tets_i64
    generic :: fetch_boundary => fetch_boundary_i32, fetch_boundary_i64
    generic :: fetch_scalars => fetch_scalars_r32, fetch_scalars_r64
    procedure :: fetch_report
    procedure :: view_points
    procedure :: view_tets
    procedure :: view_scalars
    procedure, private :: fetch_counts_i32, fetch_counts_i64, fetch_points_r32, fetch_points_r64
    procedure, private :: fetch_tets_i32, fetch_tets_i64, fetch_boundary_i32, fetch_boundary_i64
    procedure, private :: fetch_scalars_r32, fetch_scalars_r64
  end type

contains

  ! Simplifies what is submitted; the result replaces the previous one on success alone.
  subroutine run(this, stat, errmsg)
    class(tetlod_context), intent(inout) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_run(this%c_handle()), stat, errmsg)
  end subroutine

  ! Of the last result, at the original vertices and samples_per_tet (0 to 100) samples in each original tet.
  subroutine measure_error(this, samples_per_tet, report, stat, errmsg)
    class(tetlod_context), intent(inout) :: this
    integer, intent(in) :: samples_per_tet
    type(tetlod_error_report), intent(inout) :: report
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    report%struct_size = int(c_sizeof(report), c_int32_t)
    call this%settle(c_measure_error(this%c_handle(), int(samples_per_tet, c_int32_t), report), stat, errmsg)
  end subroutine

  ! counts(bins) of the original's (side 0) or the result's (side 1) vertices by value.
  subroutine histogram(this, side, bins, counts, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer, intent(in) :: side, bins
    integer(int64), allocatable, intent(out) :: counts(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    integer :: refused
    allocate (counts(min(max(bins, 1), most_bins)), source=0_int64, stat=refused)  ! more are refused
    if (refused /= 0) then
      call refuse(int(bins, int64), stat, errmsg)
      return
    end if
    status = c_histogram(this%c_handle(), int(side, c_int32_t), int(bins, c_int32_t), counts)
    if (status /= TETLOD_OK) deallocate (counts)
    call this%settle(status, stat, errmsg)
  end subroutine

  ! Fortran's own allocate had no more.
  subroutine refuse(elements, stat, errmsg)
    integer(int64), intent(in) :: elements
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(len=80) :: message
    write (message, '("no memory for an array of ", i0, " elements")') elements
    call conclude(TETLOD_ERR_MEMORY, trim(message), stat, errmsg)
  end subroutine

  subroutine fetch_report(this, report, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    type(tetlod_run_report), intent(inout) :: report
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    report%struct_size = int(c_sizeof(report), c_int32_t)
    call this%settle(c_fetch_report(this%c_handle(), report), stat, errmsg)
  end subroutine

  subroutine fetch_counts_i32(this, points, tets, boundary_triangles, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer(int32), intent(inout) :: points
    integer(int32), intent(inout), optional :: tets, boundary_triangles
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: counts(3)
    integer(c_int32_t) :: status
    status = c_fetch_counts(this%c_handle(), counts(1), counts(2), counts(3))
    if (status == TETLOD_OK) then
      points = int(counts(1), int32)
      if (present(tets)) tets = int(counts(2), int32)
      if (present(boundary_triangles)) boundary_triangles = int(counts(3), int32)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  subroutine fetch_counts_i64(this, points, tets, boundary_triangles, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer(int64), intent(inout) :: points
    integer(int64), intent(inout), optional :: tets, boundary_triangles
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: counts(3)
    integer(c_int32_t) :: status
    status = c_fetch_counts(this%c_handle(), counts(1), counts(2), counts(3))
    if (status == TETLOD_OK) then
      points = int(counts(1), int64)
      if (present(tets)) tets = int(counts(2), int64)
      if (present(boundary_triangles)) boundary_triangles = int(counts(3), int64)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! xyz(3, n).
  subroutine fetch_points_r32(this, xyz, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    real(real32), allocatable, intent(out), target :: xyz(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status
    type(tetlod_array) :: dst
    integer :: refused
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (xyz(3, n(1)), stat=refused)
      if (refused /= 0) then
        call refuse(3 * n(1), stat, errmsg)
        return
      end if
      dst = array_of(xyz)
      status = c_fetch_points(this%c_handle(), dst)
      if (status /= TETLOD_OK) deallocate (xyz)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! xyz(3, n).
  subroutine fetch_points_r64(this, xyz, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    real(real64), allocatable, intent(out), target :: xyz(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status
    type(tetlod_array) :: dst
    integer :: refused
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (xyz(3, n(1)), stat=refused)
      if (refused /= 0) then
        call refuse(3 * n(1), stat, errmsg)
        return
      end if
      dst = array_of(xyz)
      status = c_fetch_points(this%c_handle(), dst)
      if (status /= TETLOD_OK) deallocate (xyz)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! tets(4, m), each with a positive determinant of p2-p1, p3-p1, p4-p1.
  subroutine fetch_tets_i32(this, tets, index_base, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer(int32), allocatable, intent(out), target :: tets(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status, base
    type(tetlod_array) :: dst
    integer :: refused
    base = 1
    if (present(index_base)) base = int(index_base, c_int32_t)
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (tets(4, n(2)), stat=refused)
      if (refused /= 0) then
        call refuse(4 * n(2), stat, errmsg)
        return
      end if
      dst = array_of(tets)
      status = c_fetch_tets(this%c_handle(), base, dst)
      if (status /= TETLOD_OK) deallocate (tets)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! tets(4, m), each with a positive determinant of p2-p1, p3-p1, p4-p1.
  subroutine fetch_tets_i64(this, tets, index_base, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer(int64), allocatable, intent(out), target :: tets(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status, base
    type(tetlod_array) :: dst
    integer :: refused
    base = 1
    if (present(index_base)) base = int(index_base, c_int32_t)
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (tets(4, n(2)), stat=refused)
      if (refused /= 0) then
        call refuse(4 * n(2), stat, errmsg)
        return
      end if
      dst = array_of(tets)
      status = c_fetch_tets(this%c_handle(), base, dst)
      if (status /= TETLOD_OK) deallocate (tets)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! triangles(3, k), counter-clockwise seen from outside.
  subroutine fetch_boundary_i32(this, triangles, index_base, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer(int32), allocatable, intent(out), target :: triangles(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status, base
    type(tetlod_array) :: dst
    integer :: refused
    base = 1
    if (present(index_base)) base = int(index_base, c_int32_t)
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (triangles(3, n(3)), stat=refused)
      if (refused /= 0) then
        call refuse(3 * n(3), stat, errmsg)
        return
      end if
      dst = array_of(triangles)
      status = c_fetch_boundary(this%c_handle(), base, dst)
      if (status /= TETLOD_OK) deallocate (triangles)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! triangles(3, k), counter-clockwise seen from outside.
  subroutine fetch_boundary_i64(this, triangles, index_base, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer(int64), allocatable, intent(out), target :: triangles(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status, base
    type(tetlod_array) :: dst
    integer :: refused
    base = 1
    if (present(index_base)) base = int(index_base, c_int32_t)
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (triangles(3, n(3)), stat=refused)
      if (refused /= 0) then
        call refuse(3 * n(3), stat, errmsg)
        return
      end if
      dst = array_of(triangles)
      status = c_fetch_boundary(this%c_handle(), base, dst)
      if (status /= TETLOD_OK) deallocate (triangles)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! values(n).
  subroutine fetch_scalars_r32(this, values, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    real(real32), allocatable, intent(out), target :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status
    type(tetlod_array) :: dst
    integer :: refused
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (values(n(1)), stat=refused)
      if (refused /= 0) then
        call refuse(n(1), stat, errmsg)
        return
      end if
      dst = array_of(values)
      status = c_fetch_scalars(this%c_handle(), dst)
      if (status /= TETLOD_OK) deallocate (values)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! values(n).
  subroutine fetch_scalars_r64(this, values, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    real(real64), allocatable, intent(out), target :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: n(3)
    integer(c_int32_t) :: status
    type(tetlod_array) :: dst
    integer :: refused
    status = c_fetch_counts(this%c_handle(), n(1), n(2), n(3))
    if (status == TETLOD_OK) then
      allocate (values(n(1)), stat=refused)
      if (refused /= 0) then
        call refuse(n(1), stat, errmsg)
        return
      end if
      dst = array_of(values)
      status = c_fetch_scalars(this%c_handle(), dst)
      if (status /= TETLOD_OK) deallocate (values)
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! xyz(3, n): the library's own, to read, until the next successful run or destroy; null after a failure.
  subroutine view_points(this, xyz, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    real(real64), pointer, intent(out) :: xyz(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(tetlod_array) :: array
    integer(c_int32_t) :: status
    nullify (xyz)
    array = empty_array()
    status = c_view_points(this%c_handle(), array)
    if (status == TETLOD_OK) call c_f_pointer(array%data, xyz, [3_c_int64_t, array%tuples])
    call this%settle(status, stat, errmsg)
  end subroutine

  ! tets(4, m): so too. The indices count from 0.
  subroutine view_tets(this, tets, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    integer(int32), pointer, intent(out) :: tets(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(tetlod_array) :: array
    integer(c_int32_t) :: status
    nullify (tets)
    array = empty_array()
    status = c_view_tets(this%c_handle(), array)
    if (status == TETLOD_OK) call c_f_pointer(array%data, tets, [4_c_int64_t, array%tuples])
    call this%settle(status, stat, errmsg)
  end subroutine

  ! values(n): so too.
  subroutine view_scalars(this, values, stat, errmsg)
    class(tetlod_context), intent(in) :: this
    real(real64), pointer, intent(out) :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(tetlod_array) :: array
    integer(c_int32_t) :: status
    nullify (values)
    array = empty_array()
    status = c_view_scalars(this%c_handle(), array)
    if (status == TETLOD_OK) call c_f_pointer(array%data, values, [array%tuples])
    call this%settle(status, stat, errmsg)
  end subroutine
end module
