! Fields beside the scalars: they steer, too, or ride along with a run, or follow its result later.
module tetlod_fields_of_result
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_loc
  use, intrinsic :: iso_fortran_env, only: int8, int32, int64, real32, real64
  use tetlod_arrays, only: array_of
  use tetlod_c, only: c_fetch_field, c_fetch_stencil, c_submit_field, c_submit_point_flags, c_submit_steering, &
    c_transfer, c_withdraw_field
  use tetlod_submission, only: tetlod_input
  use tetlod_text, only: c_text
  use tetlod_types, only: tetlod_array
  implicit none
  private

  type, extends(tetlod_input), public :: tetlod_fields
  contains
    generic :: submit_field => submit_field_r32, submit_field_r64, submit_field_i8, submit_field_i32, submit_field_i64
    generic :: submit_steering => submit_steering_r32, submit_steering_r64
    generic :: fetch_field => fetch_field_r32, fetch_field_r64, fetch_field_i8, fetch_field_i32, fetch_field_i64
    generic :: fetch_stencil => fetch_stencil_i32, fetch_stencil_i64
    generic :: transfer => transfer_r32, transfer_r64, transfer_i8, transfer_i32, transfer_i64
    procedure :: submit_point_flags
    procedure :: withdraw_field
    procedure, private :: submit_field_r32, submit_field_r64, submit_field_i8, submit_field_i32, submit_field_i64
    procedure, private :: fetch_field_r32, fetch_field_r64, fetch_field_i8, fetch_field_i32, fetch_field_i64
    procedure, private :: submit_steering_r32, submit_steering_r64
    procedure, private :: fetch_stencil_i32, fetch_stencil_i64
    procedure, private :: transfer_r32, transfer_r64, transfer_i8, transfer_i32, transfer_i64
  end type

contains

  ! flags(n): TETLOD_FLAG_KEEP, TETLOD_FLAG_LOCK or 0 a point; borrowed.
  subroutine submit_point_flags(this, flags, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    integer(int8), intent(in), target :: flags(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_submit_point_flags(this%c_handle(), array_of(flags)), stat, errmsg)
  end subroutine

  ! Of submit_field or submit_steering: its array may go.
  subroutine withdraw_field(this, name, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char), target :: text(len_trim(name) + 1)
    text = c_text(name)
    call this%settle(c_withdraw_field(this%c_handle(), c_loc(text)), stat, errmsg)
  end subroutine

  ! ---- What all kinds have in common

  subroutine lend_field(this, name, association, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: association
    type(tetlod_array), intent(in) :: values
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char), target :: text(len_trim(name) + 1)
    text = c_text(name)
    call this%settle(c_submit_field(this%c_handle(), c_loc(text), association, values), stat, errmsg)
  end subroutine

  subroutine lend_steering(this, name, weight, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: weight
    type(tetlod_array), intent(in) :: values
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char), target :: text(len_trim(name) + 1)
    text = c_text(name)
    call this%settle(c_submit_steering(this%c_handle(), c_loc(text), weight, values), stat, errmsg)
  end subroutine

  subroutine fill_field(this, name, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    type(tetlod_array), intent(in) :: values
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char), target :: text(len_trim(name) + 1)
    type(tetlod_array) :: dst
    text = c_text(name)
    dst = values
    call this%settle(c_fetch_field(this%c_handle(), c_loc(text), dst), stat, errmsg)
  end subroutine

  subroutine move_field(this, original, simplified, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    type(tetlod_array), intent(in) :: original, simplified
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(tetlod_array) :: dst
    dst = simplified
    call this%settle(c_transfer(this%c_handle(), original, dst), stat, errmsg)
  end subroutine

  subroutine fill_stencil(this, ids, weights, index_base, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    type(tetlod_array), intent(in) :: ids, weights
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(tetlod_array) :: to_ids, to_weights
    integer(c_int32_t) :: base
    base = 1
    if (present(index_base)) base = int(index_base, c_int32_t)
    to_ids = ids
    to_weights = weights
    call this%settle(c_fetch_stencil(this%c_handle(), base, to_ids, to_weights), stat, errmsg)
  end subroutine

  ! ---- One of each kind

  ! values(n): a further field that steers, its errors weighted by weight (0 to 1e6); borrowed.
  subroutine submit_steering_r32(this, name, weight, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: weight
    real(real32), intent(in), target :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call lend_steering(this, name, weight, array_of(values), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), of points or of tets by association: TETLOD_POINT_FIELD, TETLOD_CELL_FIELD;
  ! borrowed.
  subroutine submit_field_r32(this, name, association, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: association
    real(real32), intent(in), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call lend_field(this, name, association, array_of(values), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), with room for the result's points or tets.
  subroutine fetch_field_r32(this, name, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    real(real32), intent(inout), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call fill_field(this, name, array_of(values), stat, errmsg)
  end subroutine

  ! Any point field, original(points of the run), to simplified(points of the result), or both with components before.
  subroutine transfer_r32(this, original, simplified, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    real(real32), intent(in), target :: original(..)
    real(real32), intent(inout), target :: simplified(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call move_field(this, array_of(original), array_of(simplified), stat, errmsg)
  end subroutine

  ! values(n): a further field that steers, its errors weighted by weight (0 to 1e6); borrowed.
  subroutine submit_steering_r64(this, name, weight, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: weight
    real(real64), intent(in), target :: values(:)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call lend_steering(this, name, weight, array_of(values), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), of points or of tets by association: TETLOD_POINT_FIELD, TETLOD_CELL_FIELD;
  ! borrowed.
  subroutine submit_field_r64(this, name, association, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: association
    real(real64), intent(in), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call lend_field(this, name, association, array_of(values), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), with room for the result's points or tets.
  subroutine fetch_field_r64(this, name, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    real(real64), intent(inout), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call fill_field(this, name, array_of(values), stat, errmsg)
  end subroutine

  ! Any point field, original(points of the run), to simplified(points of the result), or both with components before.
  subroutine transfer_r64(this, original, simplified, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    real(real64), intent(in), target :: original(..)
    real(real64), intent(inout), target :: simplified(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call move_field(this, array_of(original), array_of(simplified), stat, errmsg)
  end subroutine

  ! ids(4, n), counted from index_base (1), and weights(4, n) of each point of the result.
  subroutine fetch_stencil_i32(this, ids, weights, index_base, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    integer(int32), intent(inout), target :: ids(:, :)
    real(real64), intent(inout), target :: weights(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call fill_stencil(this, array_of(ids), array_of(weights), index_base, stat, errmsg)
  end subroutine

  ! ids(4, n), counted from index_base (1), and weights(4, n) of each point of the result.
  subroutine fetch_stencil_i64(this, ids, weights, index_base, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    integer(int64), intent(inout), target :: ids(:, :)
    real(real64), intent(inout), target :: weights(:, :)
    integer, intent(in), optional :: index_base
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call fill_stencil(this, array_of(ids), array_of(weights), index_base, stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), of points or of tets by association: TETLOD_POINT_FIELD, TETLOD_CELL_FIELD;
  ! borrowed.
  subroutine submit_field_i8(this, name, association, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: association
    integer(int8), intent(in), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call lend_field(this, name, association, array_of(values), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), with room for the result's points or tets.
  subroutine fetch_field_i8(this, name, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(int8), intent(inout), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call fill_field(this, name, array_of(values), stat, errmsg)
  end subroutine

  ! Any point field, original(points of the run), to simplified(points of the result), or both with components before.
  subroutine transfer_i8(this, original, simplified, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    integer(int8), intent(in), target :: original(..)
    integer(int8), intent(inout), target :: simplified(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call move_field(this, array_of(original), array_of(simplified), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), of points or of tets by association: TETLOD_POINT_FIELD, TETLOD_CELL_FIELD;
  ! borrowed.
  subroutine submit_field_i32(this, name, association, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: association
    integer(int32), intent(in), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call lend_field(this, name, association, array_of(values), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), with room for the result's points or tets.
  subroutine fetch_field_i32(this, name, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(int32), intent(inout), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call fill_field(this, name, array_of(values), stat, errmsg)
  end subroutine

  ! Any point field, original(points of the run), to simplified(points of the result), or both with components before.
  subroutine transfer_i32(this, original, simplified, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    integer(int32), intent(in), target :: original(..)
    integer(int32), intent(inout), target :: simplified(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call move_field(this, array_of(original), array_of(simplified), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), of points or of tets by association: TETLOD_POINT_FIELD, TETLOD_CELL_FIELD;
  ! borrowed.
  subroutine submit_field_i64(this, name, association, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: association
    integer(int64), intent(in), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call lend_field(this, name, association, array_of(values), stat, errmsg)
  end subroutine

  ! values(n) or values(components, n), with room for the result's points or tets.
  subroutine fetch_field_i64(this, name, values, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    character(len=*), intent(in) :: name
    integer(int64), intent(inout), target :: values(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call fill_field(this, name, array_of(values), stat, errmsg)
  end subroutine

  ! Any point field, original(points of the run), to simplified(points of the result), or both with components before.
  subroutine transfer_i64(this, original, simplified, stat, errmsg)
    class(tetlod_fields), intent(inout) :: this
    integer(int64), intent(in), target :: original(..)
    integer(int64), intent(inout), target :: simplified(..)
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call move_field(this, array_of(original), array_of(simplified), stat, errmsg)
  end subroutine
end module
