! The options of a context: generics over the kinds, one procedure an entry of the C ABI.
module tetlod_settings
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_sizeof
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use tetlod_c
  use tetlod_lifetime, only: tetlod_owner
  use tetlod_types, only: tetlod_bounds, TETLOD_OK
  implicit none
  private

  type, extends(tetlod_owner), public :: tetlod_options
  contains
    generic :: set_rho => set_rho_r32, set_rho_r64
    generic :: set_sigma => set_sigma_r32, set_sigma_r64
    generic :: set_lambda => set_lambda_r32, set_lambda_r64
    generic :: set_min_distance => set_min_distance_r32, set_min_distance_r64
    generic :: set_real => set_real_r32, set_real_r64
    generic :: set_int => set_int_i32, set_int_i64
    generic :: get_real => get_real_r32, get_real_r64
    generic :: get_int => get_int_i32, get_int_i64
    procedure :: set_preset
    procedure, private :: set_rho_r32, set_rho_r64, set_sigma_r32, set_sigma_r64
    procedure, private :: set_lambda_r32, set_lambda_r64, set_min_distance_r32, set_min_distance_r64
    procedure, private :: set_real_r32, set_real_r64, set_int_i32, set_int_i64
    procedure, private :: get_real_r32, get_real_r64, get_int_i32, get_int_i64
  end type

contains

  ! preset: TETLOD_PRESET_PAPER, ...
  subroutine set_preset(this, preset, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    integer(c_int32_t), intent(in) :: preset
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_preset(this%c_handle(), preset), stat, errmsg)
  end subroutine

  subroutine set_rho_r32(this, rho, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real32), intent(in) :: rho
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_rho(this%c_handle(), real(rho, c_double)), stat, errmsg)
  end subroutine

  subroutine set_rho_r64(this, rho, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real64), intent(in) :: rho
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_rho(this%c_handle(), real(rho, c_double)), stat, errmsg)
  end subroutine

  subroutine set_sigma_r32(this, sigma, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real32), intent(in) :: sigma
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_sigma(this%c_handle(), real(sigma, c_double)), stat, errmsg)
  end subroutine

  subroutine set_sigma_r64(this, sigma, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real64), intent(in) :: sigma
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_sigma(this%c_handle(), real(sigma, c_double)), stat, errmsg)
  end subroutine

  subroutine set_lambda_r32(this, lambda, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real32), intent(in) :: lambda
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_lambda(this%c_handle(), real(lambda, c_double)), stat, errmsg)
  end subroutine

  subroutine set_lambda_r64(this, lambda, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real64), intent(in) :: lambda
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_lambda(this%c_handle(), real(lambda, c_double)), stat, errmsg)
  end subroutine

  subroutine set_min_distance_r32(this, min_distance, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real32), intent(in) :: min_distance
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_min_distance(this%c_handle(), real(min_distance, c_double)), stat, errmsg)
  end subroutine

  subroutine set_min_distance_r64(this, min_distance, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    real(real64), intent(in) :: min_distance
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_min_distance(this%c_handle(), real(min_distance, c_double)), stat, errmsg)
  end subroutine

  subroutine set_real_r32(this, option, value, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    integer(c_int32_t), intent(in) :: option
    real(real32), intent(in) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_real(this%c_handle(), option, double_of(option, value)), stat, errmsg)
  end subroutine

  ! The largest value of the option itself, where that is what was rounded: 0.1 in single precision is more.
  function double_of(option, value) result(double)
    integer(c_int32_t), intent(in) :: option
    real(real32), intent(in) :: value
    real(c_double) :: double
    type(tetlod_bounds) :: bounds
    double = real(value, c_double)
    if (ieee_is_nan(value)) return  ! to compare it may trap
    bounds%struct_size = int(c_sizeof(bounds), c_int32_t)
    if (c_option_bounds(option, bounds) /= TETLOD_OK) return
    if (value <= real(bounds%most, real32)) double = min(double, bounds%most)
  end function

  subroutine set_real_r64(this, option, value, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    integer(c_int32_t), intent(in) :: option
    real(real64), intent(in) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_real(this%c_handle(), option, real(value, c_double)), stat, errmsg)
  end subroutine

  subroutine set_int_i32(this, option, value, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    integer(c_int32_t), intent(in) :: option
    integer(int32), intent(in) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_int(this%c_handle(), option, int(value, c_int64_t)), stat, errmsg)
  end subroutine

  subroutine set_int_i64(this, option, value, stat, errmsg)
    class(tetlod_options), intent(inout) :: this
    integer(c_int32_t), intent(in) :: option
    integer(int64), intent(in) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    call this%settle(c_set_int(this%c_handle(), option, int(value, c_int64_t)), stat, errmsg)
  end subroutine

  subroutine get_real_r32(this, option, value, stat, errmsg)
    class(tetlod_options), intent(in) :: this
    integer(c_int32_t), intent(in) :: option
    real(real32), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: answer
    integer(c_int32_t) :: status
    answer = 0
    status = c_get_real(this%c_handle(), option, answer)
    if (status == TETLOD_OK) value = real(answer, real32)
    call this%settle(status, stat, errmsg)
  end subroutine

  subroutine get_real_r64(this, option, value, stat, errmsg)
    class(tetlod_options), intent(in) :: this
    integer(c_int32_t), intent(in) :: option
    real(real64), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    real(c_double) :: answer
    integer(c_int32_t) :: status
    answer = 0
    status = c_get_real(this%c_handle(), option, answer)
    if (status == TETLOD_OK) value = real(answer, real64)
    call this%settle(status, stat, errmsg)
  end subroutine

  ! A value beyond int32 (a seed may be) is cut to huge(value).
  subroutine get_int_i32(this, option, value, stat, errmsg)
    class(tetlod_options), intent(in) :: this
    integer(c_int32_t), intent(in) :: option
    integer(int32), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: answer
    integer(c_int32_t) :: status
    answer = 0
    status = c_get_int(this%c_handle(), option, answer)
    if (status == TETLOD_OK) value = int(min(answer, int(huge(value), c_int64_t)), int32)
    call this%settle(status, stat, errmsg)
  end subroutine

  subroutine get_int_i64(this, option, value, stat, errmsg)
    class(tetlod_options), intent(in) :: this
    integer(c_int32_t), intent(in) :: option
    integer(int64), intent(inout) :: value
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int64_t) :: answer
    integer(c_int32_t) :: status
    answer = 0
    status = c_get_int(this%c_handle(), option, answer)
    if (status == TETLOD_OK) value = int(answer, int64)
    call this%settle(status, stat, errmsg)
  end subroutine
end module
