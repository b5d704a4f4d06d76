! A context's handle, its callbacks, and what a failure becomes.
module tetlod_lifetime
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_funloc, c_funptr, c_int32_t, c_int64_t, &
    c_loc, c_null_funptr, c_null_ptr, c_ptr, c_associated, c_size_t, c_sizeof
  use tetlod_c
  use tetlod_text, only: c_text, fortran_text
  use tetlod_types, only: tetlod_config, TETLOD_API_VERSION, TETLOD_ERR_ARGUMENT, TETLOD_ERR_MEMORY, TETLOD_ERR_STATE, &
    TETLOD_OK, TETLOD_OPT_THREADS
  implicit none
  private
  public :: tetlod_log_procedure, tetlod_progress_procedure

  abstract interface
    ! level: 0 debug, 1 info, 2 warning. user is what was given with the procedure, null without. gfortran 12 lets a
    ! select type on it not write to an integer or a real: do that by a pointer of your own, p => user.
    subroutine tetlod_log_procedure(level, message, user)
      import :: c_int32_t
      integer(c_int32_t), intent(in) :: level
      character(len=*), intent(in) :: message
      class(*), pointer, intent(in) :: user
    end subroutine
    ! stage: see tetlod_stage_name; fraction of that stage in [0, 1]. cancel is .false. on entry; .true. ends the run.
    subroutine tetlod_progress_procedure(stage, fraction, cancel, user)
      import :: c_double, c_int32_t
      integer(c_int32_t), intent(in) :: stage
      real(c_double), intent(in) :: fraction
      logical, intent(inout) :: cancel
      class(*), pointer, intent(in) :: user
    end subroutine
  end interface

  ! What C gets as its user pointer: it stays in place when the context's variable does not. As old as the context.
  type :: callbacks
    procedure(tetlod_log_procedure), pointer, nopass :: log => null()
    procedure(tetlod_progress_procedure), pointer, nopass :: progress => null()
    class(*), pointer :: log_user => null(), progress_user => null()
  end type

  ! Copies of a context are the same context: destroy one of them, once.
  type, public :: tetlod_owner
    private
    type(c_ptr) :: handle = c_null_ptr
    type(callbacks), pointer :: called => null()
  contains
    procedure :: create
    procedure :: destroy
    procedure :: cancel
    procedure :: set_log
    procedure :: set_progress
    procedure :: last_message
    procedure :: c_handle
    procedure :: settle
  end type

  ! For the modules of this folder: the end of a call without a context's message, and that of the thread's last one.
  public :: conclude, message_of

contains

  ! memory_limit in bytes, not negative, 0 for none; remesher is the path of tetlod-remesh. allocate and release are C
  ! functions as in tetlod_config.
  subroutine create(this, memory_limit, remesher, allocate, release, allocator_user, stat, errmsg)
    class(tetlod_owner), intent(inout) :: this
    integer(c_int64_t), intent(in), optional :: memory_limit
    character(len=*), intent(in), optional :: remesher
    type(c_funptr), intent(in), optional :: allocate, release
    type(c_ptr), intent(in), optional :: allocator_user
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    character(kind=c_char), allocatable, target :: path(:)
    character(len=20) :: digits
    type(tetlod_config) :: config
    integer(c_int32_t) :: status
    integer :: refused
    if (c_associated(this%handle)) then
      call conclude(TETLOD_ERR_STATE, "create: the context exists already; destroy it first", stat, errmsg)
      return
    end if
    if (present(memory_limit)) then
      if (memory_limit < 0) then
        write (digits, "(i0)") memory_limit
        call conclude(TETLOD_ERR_ARGUMENT, "create: the memory limit is "//trim(digits)//" bytes", stat, errmsg)
        return
      end if
    end if
    config%struct_size = int(c_sizeof(config), c_int32_t)
    config%api_version = TETLOD_API_VERSION
    if (present(memory_limit)) config%memory_limit = memory_limit
    if (present(allocate)) config%allocate = allocate
    if (present(release)) config%release = release
    if (present(allocator_user)) config%allocator_user = allocator_user
    if (present(remesher)) then
      allocate (path, source=c_text(remesher), stat=refused)
      if (refused /= 0) then
        call conclude(TETLOD_ERR_MEMORY, "create: no memory for the path of the remesher", stat, errmsg)
        return
      end if
      config%remesher = c_loc(path)
    end if
    allocate (this%called, stat=refused)
    if (refused /= 0) then
      call conclude(TETLOD_ERR_MEMORY, "create: no memory for the callbacks", stat, errmsg)
      return
    end if
    status = c_create(config, this%handle)
    if (status /= TETLOD_OK) deallocate (this%called)
    call conclude(status, this%last_message(), stat, errmsg)
  end subroutine

  ! Ends the context and its result; the submitted arrays are free again. Allowed without a context; of copies one alone
  ! may be destroyed, as the others know nothing of it. Does nothing inside a callback of the context.
  subroutine destroy(this)
    class(tetlod_owner), intent(inout) :: this
    integer(c_int32_t) :: status
    status = status_of(this)
    if (status == TETLOD_ERR_STATE) return
    if (status == TETLOD_OK) then
      call c_destroy(this%handle)
      deallocate (this%called)
    end if
    this%handle = c_null_ptr
    nullify (this%called)
  end subroutine

  ! What C says to any call: a failure inside a callback, without a context, or where there is none any more.
  function status_of(this) result(status)
    class(tetlod_owner), intent(in) :: this
    integer(c_int32_t) :: status
    integer(c_int64_t) :: threads
    threads = 0
    status = c_get_int(this%handle, TETLOD_OPT_THREADS, threads)
  end function

  ! The one call allowed from another thread.
  subroutine cancel(this)
    class(tetlod_owner), intent(in) :: this
    call c_cancel(this%handle)
  end subroutine

  ! Without a procedure: no log. user must live as long as the procedure is set. Inside a callback of the context this
  ! is TETLOD_ERR_STATE, and what was set remains, as C may be about to call it: C is asked first.
  subroutine set_log(this, log, min_level, user, stat, errmsg)
    class(tetlod_owner), intent(inout) :: this
    procedure(tetlod_log_procedure), optional :: log
    integer, intent(in), optional :: min_level
    class(*), intent(inout), target, optional :: user
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_funptr) :: function
    integer(c_int32_t) :: level, status
    function = c_null_funptr
    if (present(log)) function = c_funloc(call_log)
    level = 1
    if (present(min_level)) level = int(min_level, c_int32_t)
    status = c_set_log(this%handle, function, callbacks_of(this), level)
    if (status == TETLOD_OK) then
      nullify (this%called%log, this%called%log_user)
      if (present(log)) this%called%log => log
      if (present(user)) this%called%log_user => user
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! Without a procedure: none. user must live as long as the procedure is set.
  subroutine set_progress(this, progress, user, stat, errmsg)
    class(tetlod_owner), intent(inout) :: this
    procedure(tetlod_progress_procedure), optional :: progress
    class(*), intent(inout), target, optional :: user
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    type(c_funptr) :: function
    integer(c_int32_t) :: status
    function = c_null_funptr
    if (present(progress)) function = c_funloc(call_progress)
    status = c_set_progress(this%handle, function, callbacks_of(this))
    if (status == TETLOD_OK) then
      nullify (this%called%progress, this%called%progress_user)
      if (present(progress)) this%called%progress => progress
      if (present(user)) this%called%progress_user => user
    end if
    call this%settle(status, stat, errmsg)
  end subroutine

  ! Null without a context.
  function callbacks_of(this) result(user)
    class(tetlod_owner), intent(in) :: this
    type(c_ptr) :: user
    user = c_null_ptr
    if (associated(this%called)) user = c_loc(this%called)
  end function

  subroutine call_log(user, level, message) bind(C, name="")
    type(c_ptr), value :: user, message
    integer(c_int32_t), value :: level
    type(callbacks), pointer :: called
    call c_f_pointer(user, called)
    call called%log(level, fortran_text(message), called%log_user)
  end subroutine

  function call_progress(user, stage, fraction) result(cancelled) bind(C, name="")
    type(c_ptr), value :: user
    integer(c_int32_t), value :: stage
    real(c_double), value :: fraction
    integer(c_int32_t) :: cancelled
    type(callbacks), pointer :: called
    logical :: cancel
    call c_f_pointer(user, called)
    cancel = .false.
    call called%progress(stage, fraction, cancel, called%progress_user)
    cancelled = merge(1_c_int32_t, 0_c_int32_t, cancel)
  end function

  ! The message of the last call that failed.
  function last_message(this) result(message)
    class(tetlod_owner), intent(in) :: this
    character(len=:), allocatable :: message
    message = message_of(this%handle)
  end function

  ! The same of a context of C, or, for null, of the thread's calls without one.
  function message_of(handle) result(message)
    type(c_ptr), intent(in) :: handle
    character(len=:), allocatable :: message
    character(kind=c_char), allocatable, target :: buffer(:)
    integer(c_size_t) :: length
    integer :: refused
    length = c_last_message(handle, c_null_ptr, 0_c_size_t)
    message = ""
    allocate (buffer(length + 1), stat=refused)
    if (refused /= 0) return
    length = c_last_message(handle, c_loc(buffer), length + 1)
    message = fortran_text(c_loc(buffer))
  end function

  ! The tetlod_context * of the C ABI, null before create.
  function c_handle(this) result(handle)
    class(tetlod_owner), intent(in) :: this
    type(c_ptr) :: handle
    handle = this%handle
  end function

  ! The end of every call on a context.
  subroutine settle(this, status, stat, errmsg)
    class(tetlod_owner), intent(in) :: this
    integer(c_int32_t), intent(in) :: status
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    if (status == TETLOD_OK) then
      if (present(stat)) stat = int(TETLOD_OK)
    else if (c_associated(this%handle)) then
      call conclude(status, this%last_message(), stat, errmsg)
    else
      call conclude(status, "there is no context: call create first. "//this%last_message(), stat, errmsg)
    end if
  end subroutine

  ! With stat a failure is told, without it ends the program.
  subroutine conclude(status, message, stat, errmsg)
    integer(c_int32_t), intent(in) :: status
    character(len=*), intent(in) :: message
    integer, intent(out), optional :: stat
    character(len=*), intent(inout), optional :: errmsg
    if (present(stat)) stat = int(status)
    if (status == TETLOD_OK) return
    if (present(errmsg)) errmsg = message
    if (.not. present(stat)) error stop "tetlod: "//message
  end subroutine
end module
