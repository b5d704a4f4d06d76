! Lending a mesh and its values. Nothing is copied: the actual arguments must live, unchanged in place and shape, until
! the same is submitted again, clear, or destroy. Give them the target attribute; sections (also backward ones) are
! read in place, while an expression or a vector subscript is a temporary that dies on return, and must not be given.
! Nor must a component of an array of a derived type, nodes%x, of which gfortran makes a temporary as well; lend a
! section of a view of the same memory: call c_f_pointer(c_loc(nodes), raw, [reals_a_node, n]), then raw(1:3, :).
module tetlod_submission
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_sizeof, c_char, c_loc
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use tetlod_arrays, only: array_of
  use tetlod_c
  use tetlod_settings, only: tetlod_options
  use tetlod_text, only: c_text
  use tetlod_types, only: tetlod_mesh_report
  implicit none
  private

  type, extends(tetlod_options), public :: tetlod_input
  contains
    generic :: submit_points => submit_points_r32, submit_points_r64
    generic :: submit_points_xyz => submit_points_xyz_r32, submit_points_xyz_r64
    generic :: submit_tets => submit_tets_i32, submit_tets_i64
    generic :: submit_scalars => submit_scalars_r32, submit_scalars_r64
    procedure :: clear
    procedure :: check
    procedure :: estimate_memory
    procedure, private :: submit_points_r32, submit_points_r64, submit_points_xyz_r32, submit_points_xyz_r64
    procedure, private :: submit_tets_i32, submit_tets_i64, submit_scalars_r32, submit_scalars_r64
  end type

contains

  ! xyz(3, n).
  subroutine submit_points_r32(this, xyz, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    real(real32), intent(in), target :: xyz(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_submit_points(this%c_handle(), array_of(xyz)), stat, errmsg)
  end subroutine

  ! xyz(3, n).
  subroutine submit_points_r64(this, xyz, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    real(real64), intent(in), target :: xyz(:, :)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_submit_points(this%c_handle(), array_of(xyz)), stat, errmsg)
  end subroutine

  ! x(n), y(n), z(n); for an array xyz(n, 3): xyz(:, 1), xyz(:, 2), xyz(:, 3).
  subroutine submit_points_xyz_r32(this, x, y, z, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    real(real32), intent(in), target :: x(:), y(:), z(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_submit_points_xyz(this%c_handle(), array_of(x), array_of(y), array_of(z)), stat, errmsg)
  end subroutine

  ! x(n), y(n), z(n); for an array xyz(n, 3): xyz(:, 1), xyz(:, 2), xyz(:, 3).
  subroutine submit_points_xyz_r64(this, x, y, z, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    real(real64), intent(in), target :: x(:), y(:), z(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_submit_points_xyz(this%c_handle(), array_of(x), array_of(y), array_of(z)), stat, errmsg)
  end subroutine

  ! tets(4, m); index_base 1 (the default) or 0 is the number of the first point.
  subroutine submit_tets_i32(this, tets, index_base, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    integer(int32), intent(in), target :: tets(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: base
    base = 1
    if (present(index_base)) base = int(index_base, c_int32_t)
    call this%settle(c_submit_tets(this%c_handle(), array_of(tets), base), stat, errmsg)
  end subroutine

  ! tets(4, m); index_base 1 (the default) or 0 is the number of the first point.
  subroutine submit_tets_i64(this, tets, index_base, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    integer(int64), intent(in), target :: tets(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: base
    base = 1
    if (present(index_base)) base = int(index_base, c_int32_t)
    call this%settle(c_submit_tets(this%c_handle(), array_of(tets), base), stat, errmsg)
  end subroutine

  ! values(n): the field that steers the simplification.
  subroutine submit_scalars_r32(this, name, values, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    character(len=*), intent(in) :: name
    real(real32), intent(in), target :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char), target :: text(len_trim(name) + 1)
    text = c_text(name)
    call this%settle(c_submit_scalars(this%c_handle(), c_loc(text), array_of(values)), stat, errmsg)
  end subroutine

  ! values(n): the field that steers the simplification.
  subroutine submit_scalars_r64(this, name, values, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    character(len=*), intent(in) :: name
    real(real64), intent(in), target :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char), target :: text(len_trim(name) + 1)
    text = c_text(name)
    call this%settle(c_submit_scalars(this%c_handle(), c_loc(text), array_of(values)), stat, errmsg)
  end subroutine

  ! Gives back what was submitted, keeps options and the last result.
  subroutine clear(this, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_clear(this%c_handle()), stat, errmsg)
  end subroutine

  ! Counts the defects of what is submitted. No failure for a bad mesh: report%status says what run would.
  subroutine check(this, report, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    type(tetlod_mesh_report), intent(inout) :: report
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    report%struct_size = int(c_sizeof(report), c_int32_t)
    call this%settle(c_check(this%c_handle(), report), stat, errmsg)
  end subroutine

  ! Of a run with what is submitted and the options as they are, within a factor of 1.5 on a sound mesh.
  subroutine estimate_memory(this, bytes, stat, errmsg)
    class(tetlod_input), intent(inout) :: this
    integer(c_int64_t), intent(inout) :: bytes
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_estimate_memory(this%c_handle(), bytes), stat, errmsg)
  end subroutine
end module
