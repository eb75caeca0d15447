! utan41 of LS-DYNA, the tangent that goes with umat41 in an implicit
! analysis, one element at a time.
!
! The deck is that of umat41. The kinds of REAL, INTEGER and LOGICAL are
! those of the build, so compile this file with the object package's
! own flags.
!
! The argument list is that of R11 and R12. Packages of 2014 and 2015
! have no UNSYM and NNPCRV.
!
! Fixed form: statements in columns 7 to 72, continued in column 6, and
! nothing beyond. Compile it as .f; free form is not supported.
      subroutine utan41(cm, eps, sig, epsp, hsv, dt1, unsym, capa,
     &  etype, tt, temper, es, crv, nnpcrv, failel, cma, qmat)
      use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float,
     &  c_int32_t, c_null_char, c_size_t
      implicit none
      real :: cm(*), eps(6), sig(6), epsp, hsv(*), dt1, capa, tt, temper
      real :: es(*), crv(*), cma(*), qmat(3, 3)
      character(len=5) :: etype
      logical :: unsym, failel
      integer :: nnpcrv(*)
!     What the library needs, not what the card says: LS-DYNA hands NHV
!     to no routine. With another one F is not where it is read.
      integer(c_int32_t), parameter :: nhv = 11
      integer(c_int32_t) :: status
!     Room for any message of the library.
      integer(c_size_t), parameter :: capacity = 512
      character(kind=c_char) :: message(capacity)

!     The default kind of REAL picks the precision.
      interface toron_utan
        function toron_lsdyna_utan_f64(cm, hsv, nhv, es, message,
     &    capacity) bind(c) result(status)
          import :: c_char, c_double, c_int32_t, c_size_t
          real(c_double), intent(in) :: cm(*), hsv(*)
          integer(c_int32_t), value :: nhv
          real(c_double), intent(inout) :: es(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
        function toron_lsdyna_utan_f32(cm, hsv, nhv, es, message,
     &    capacity) bind(c) result(status)
          import :: c_char, c_float, c_int32_t, c_size_t
          real(c_float), intent(in) :: cm(*), hsv(*)
          integer(c_int32_t), value :: nhv
          real(c_float), intent(inout) :: es(*)
          character(kind=c_char), intent(inout) :: message(*)
          integer(c_size_t), value :: capacity
          integer(c_int32_t) :: status
        end function
      end interface

      status = toron_utan(cm, hsv, nhv, es, message, capacity)
!     Below -300 the element is at fault, and has no stiffness; above,
!     the deck is.
      if (status < 0 .and. status > -300) call refuse

      contains

      subroutine refuse
      integer :: length
      length = 0
      do while (message(length + 1) /= c_null_char)
        length = length + 1
      end do
      write (*, '(1x, *(a))') 'toron: ', message(1:length)
      call adios(2)
      end subroutine
      end subroutine
