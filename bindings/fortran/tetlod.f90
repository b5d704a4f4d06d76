! tetlod from Fortran: simplification of tetrahedral meshes that carry a scalar field, inside the program that computed
! them. tetlod.h is the reference; the procedures of a context are its functions without the prefix.
!
!     use tetlod
!     type(tetlod_context) :: lod
!     call lod%create()
!     call lod%set_real(TETLOD_OPT_TARGET_RATIO, 0.1)
!     call lod%submit_points(xyz); call lod%submit_tets(tets); call lod%submit_scalars("density", rho)
!     call lod%run(stat=ierr, errmsg=message)
!     call lod%fetch_points(xyz_small); call lod%fetch_tets(tets_small); call lod%fetch_scalars(rho_small)
!     call lod%destroy()
!
! Every procedure that can fail ends with optional stat and errmsg; without stat a failure is an error stop.
! A new function of tetlod.h is bound in tetlod_c.f90 and becomes a procedure of one of the types that
! tetlod_context extends: tetlod_options, tetlod_input, or of tetlod_context itself in tetlod_results.f90.
module tetlod
  use, intrinsic :: iso_c_binding, only: c_char, c_int32_t, c_loc, c_null_ptr, c_sizeof
  use tetlod_c, only: c_build_info, c_option_bounds, c_option_from_name, c_option_name, c_stage_name, c_status_text, &
    c_version
  use tetlod_lifetime, only: conclude, message_of, tetlod_log_procedure, tetlod_progress_procedure
  use tetlod_results, only: tetlod_context
  use tetlod_text, only: c_text, fortran_text
  use tetlod_types
  implicit none
  private :: c_char, c_int32_t, c_loc, c_null_ptr, c_sizeof, conclude, message_of, c_text, fortran_text, tetlod_array
  private :: tetlod_config
  private :: c_version, c_build_info, c_status_text, c_stage_name, c_option_bounds, c_option_from_name, c_option_name

contains

  subroutine tetlod_version(major, minor, patch)
    integer(c_int32_t), intent(out) :: major, minor, patch
    call c_version(major, minor, patch)
  end subroutine

  ! One line: version, libraries, licences.
  function tetlod_build_info() result(text)
    character(len=:), allocatable :: text
    text = fortran_text(c_build_info())
  end function

  ! A sentence for a status.
  function tetlod_status_text(status) result(text)
    integer(c_int32_t), intent(in) :: status
    character(len=:), allocatable :: text
    text = fortran_text(c_status_text(status))
  end function

  ! "boundary", "decimate", ... for the stages that the progress procedure is told.
  function tetlod_stage_name(stage) result(text)
    integer(c_int32_t), intent(in) :: stage
    character(len=:), allocatable :: text
    text = fortran_text(c_stage_name(stage))
  end function

  ! Smallest, largest and default value of an option.
  subroutine tetlod_option_bounds(option, bounds, stat, errmsg)
    integer(c_int32_t), intent(in) :: option
    type(tetlod_bounds), intent(inout) :: bounds
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    integer(c_int32_t) :: status
    bounds%struct_size = int(c_sizeof(bounds), c_int32_t)
    status = c_option_bounds(option, bounds)
    call conclude(status, "option_bounds: "//message_of(c_null_ptr), stat, errmsg)
  end subroutine

  ! 0 for a name that is no option.
  function tetlod_option_from_name(name) result(option)
    character(len=*), intent(in) :: name
    integer(c_int32_t) :: option
    character(kind=c_char), target :: text(len_trim(name) + 1)
    text = c_text(name)
    option = c_option_from_name(c_loc(text))
  end function

  ! Empty for a number that is no option.
  function tetlod_option_name(option) result(text)
    integer(c_int32_t), intent(in) :: option
    character(len=:), allocatable :: text
    text = fortran_text(c_option_name(option))
  end function
end module
