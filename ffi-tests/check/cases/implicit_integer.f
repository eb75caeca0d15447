C     Neo-Hooke, compressible, by the isochoric part of b = F F^T.
C
C       W = mu/2 (tr bbar - 3) + kappa/2 (J - 1)**2, bbar = J**(-2/3) b
C       J sigma = mu dev bbar + kappa J (J - 1) I
C
C     PROPS   1 shear modulus mu, 2 bulk modulus kappa
C     STATEV  none
C     DDSDDE  Jaumann rate of the Kirchhoff stress, over J
C     SSE     W / J, of the current volume
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,RPL,DDSDDT,
     1 DRPLDE,DRPLDT,STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,
     2 CMNAME,NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     3 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),DDSDDE(NTENS,NTENS),
     1 DDSDDT(NTENS),DRPLDE(NTENS),STRAN(NTENS),DSTRAN(NTENS),
     2 TIME(2),PREDEF(1),DPRED(1),PROPS(NPROPS),COORDS(3),DROT(3,3),
     3 DFGRD0(3,3),DFGRD1(3,3),JSTEP(4)
      DIMENSION B(3,3),DELTA(3,3),IROW(6),ICOL(6)
      DATA IROW /1,2,3,1,1,2/, ICOL /1,2,3,2,3,3/
      DATA DELTA /1.D0,3*0.D0,1.D0,3*0.D0,1.D0/
C
      DO 10 N = 1, NTENS
        DO 10 M = 1, NTENS
          DDSDDE(M,N) = 0.D0
   10 CONTINUE
      DET = DFGRD1(1,1)*(DFGRD1(2,2)*DFGRD1(3,3)
     1                  -DFGRD1(2,3)*DFGRD1(3,2))
     2     -DFGRD1(1,2)*(DFGRD1(2,1)*DFGRD1(3,3)
     3                  -DFGRD1(2,3)*DFGRD1(3,1))
     4     +DFGRD1(1,3)*(DFGRD1(2,1)*DFGRD1(3,2)
     5                  -DFGRD1(2,2)*DFGRD1(3,1))
C     An inverted element, or not a number: a smaller increment.
      IF (.NOT. DET .GT. 0.D0) THEN
        PNEWDT = 0.25D0
        RETURN
      END IF
      MU = PROPS(1)
      XKAPPA = PROPS(2)
C
      SCALE = DET**(-2.D0/3.D0)
      DO 20 J = 1, 3
        DO 20 I = 1, 3
          B(I,J) = SCALE*(DFGRD1(I,1)*DFGRD1(J,1)
     1           + DFGRD1(I,2)*DFGRD1(J,2) + DFGRD1(I,3)*DFGRD1(J,3))
   20 CONTINUE
      TRB = B(1,1) + B(2,2) + B(3,3)
      PRESS = XKAPPA*(DET - 1.D0)
      STIFF = XKAPPA*(2.D0*DET - 1.D0)
C
C     d(dev bbar) = dev (d bbar + bbar d - 2/3 tr d bbar) in axes that
C     turn with the material.
      DO 40 M = 1, NTENS
        I = IROW(M)
        J = ICOL(M)
        STRESS(M) = MU/DET*(B(I,J) - DELTA(I,J)*TRB/3.D0)
     1            + PRESS*DELTA(I,J)
        DO 30 N = 1, NTENS
          K = IROW(N)
          L = ICOL(N)
          TURNED = DELTA(I,K)*B(J,L) + DELTA(I,L)*B(J,K)
     1           + DELTA(J,L)*B(I,K) + DELTA(J,K)*B(I,L)
          CROSS = DELTA(I,J)*B(K,L) + B(I,J)*DELTA(K,L)
          DDSDDE(M,N) = MU/DET*(0.5D0*TURNED - 2.D0/3.D0*CROSS
     1                + 2.D0/9.D0*TRB*DELTA(I,J)*DELTA(K,L))
     2                + STIFF*DELTA(I,J)*DELTA(K,L)
   30   CONTINUE
   40 CONTINUE
      SSE = (0.5D0*MU*(TRB - 3.D0)
     1     + 0.5D0*XKAPPA*(DET - 1.D0)**2)/DET
      RETURN
      END
